// A value whose dimension depends on another key, which names a quantity: a number in SI, or with a unit ("1 mJ").
// require() checks the unit.
#pragma once

#include <string>

#include "lib/config/spec.h"

namespace orthodyn {

// Shown in lists of keys in place of a unit.
inline constexpr std::string_view kUnitOfQuantity = "unit of the quantity";

class QuantityValue {
 public:
  QuantityValue(double si = 0, std::string unit = "") : si_(si), unit_(std::move(unit)) {}

  double si() const { return si_; }
  operator double() const { return si_; }

  // Throws ConfigError at `origin` if a unit was given whose dimension is not that of `si_unit` ("" or "1":
  // dimensionless).
  void require(const std::string& si_unit, const SourceLocation& origin) const;

 private:
  double si_;
  std::string unit_;  // "" if none was given
};

template <>
struct Value<QuantityValue> {
  static ValueSchema schema() {
    return {.kind = ValueSchema::Kind::either,
            .words = "number with unit",
            .items = {Value<double>::schema(), {.kind = ValueSchema::Kind::text}}};
  }
  static QuantityValue read(const Config& c, const Rule& r);
  static std::string yaml(const QuantityValue& x) { return number_text(x.si()); }
};

}  // namespace orthodyn
