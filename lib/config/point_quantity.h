// A quantity that may depend on the place: a number, with a unit if wanted ("12 kPa"), or a formula of the coordinates
// x, y, z (m) with its value in the SI unit of the key: "9810*(2 - z)".
#pragma once

#include <string>
#include <variant>

#include "lib/config/formula.h"

namespace orthodyn {

class PointQuantity {
 public:
  PointQuantity(double value = 0) : value_(value) {}
  explicit PointQuantity(PointFormula formula) : value_(std::move(formula)) {}

  // Whether it is a number, the same everywhere.
  bool uniform() const { return std::holds_alternative<double>(value_); }

  // Throws ConfigError where a formula has no value.
  double at(const Vec3& x) const { return uniform() ? std::get<double>(value_) : std::get<PointFormula>(value_).at(x); }

  std::string text() const {
    return uniform() ? number_text(std::get<double>(value_)) : std::get<PointFormula>(value_).text();
  }

 private:
  std::variant<double, PointFormula> value_;
};

template <>
struct Value<PointQuantity> {
  static ValueSchema schema();
  static PointQuantity read(const Config& c, const Rule& r);
  static std::string yaml(const PointQuantity& q) { return q.text(); }
};

}  // namespace orthodyn
