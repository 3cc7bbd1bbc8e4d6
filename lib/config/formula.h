// Formulas in the input, such as "105*sin(pi*y/12)", in muParser's syntax with the constants pi and e. Variables are
// the coordinates x, y, z (m), the time t (s), or both. Thread-safe; evaluations of copies of one formula are
// serialised.
#pragma once

#include <concepts>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "lib/config/values.h"
#include "lib/core/types.h"

namespace orthodyn {

class Formula {
 public:
  // `where`: place in the input, for messages. Throws std::invalid_argument with muParser's message.
  Formula(const std::string& text, const std::vector<std::string>& variables, std::string where);
  const std::string& text() const { return text_; }
  bool uses(const std::string& variable) const;

 protected:
  // `values`: one per variable, in the order given to the constructor. Throws ConfigError if the result is not finite.
  double evaluate(const double* values) const;

 private:
  struct Parsed;
  std::string text_, where_;
  std::shared_ptr<const Parsed> parsed_;
};

class PointFormula : public Formula {
 public:
  static constexpr const char* kVariables = "x, y, z";
  PointFormula() : PointFormula("0") {}
  explicit PointFormula(const std::string& text, std::string where = "")
      : Formula(text, {"x", "y", "z"}, std::move(where)) {}
  double at(const Vec3& x) const { return evaluate(x.data()); }
};

class TimeFormula : public Formula {
 public:
  static constexpr const char* kVariables = "t";
  TimeFormula() : TimeFormula("0") {}
  explicit TimeFormula(const std::string& text, std::string where = "") : Formula(text, {"t"}, std::move(where)) {}
  double at(double t) const { return evaluate(&t); }
};

class TimePointFormula : public Formula {
 public:
  static constexpr const char* kVariables = "t, x, y, z";
  TimePointFormula() : TimePointFormula("0") {}
  explicit TimePointFormula(const std::string& text, std::string where = "")
      : Formula(text, {"t", "x", "y", "z"}, std::move(where)) {}
  double at(double t, const Vec3& x) const {
    const double values[] = {t, x[0], x[1], x[2]};
    return evaluate(values);
  }
};

// Throws ConfigError for a formula that cannot be parsed. `known`: the variables; `complaint`: muParser's message.
[[noreturn]] void fail_formula(const Config& c, const std::string& known, const std::string& complaint);

template <class F>
requires std::derived_from<F, Formula>
struct Value<F> {
  static ValueSchema schema() {
    return {.kind = ValueSchema::Kind::either,
            .words = std::string("formula of ") + F::kVariables,
            .items = {Value<double>::schema(), Value<std::string>::schema()}};
  }
  static F read(const Config& c, const Rule&) {
    try {
      return F(c.text(), c.where());
    } catch (const std::invalid_argument& e) {
      fail_formula(c, F::kVariables, e.what());
    }
  }
  static std::string yaml(const F& f) { return f.text(); }
};

// A quantity that may vary in space: a number, optionally with a unit ("12 kPa"), or a formula of the coordinates x, y,
// z (m) whose value is in the key's SI unit: "9810*(2 - z)".
class PointQuantity {
 public:
  PointQuantity(double value = 0) : value_(value) {}
  explicit PointQuantity(PointFormula formula) : value_(std::move(formula)) {}

  // True for a number, false for a formula.
  bool uniform() const { return std::holds_alternative<double>(value_); }

  // Throws ConfigError if a formula is not finite at x.
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
