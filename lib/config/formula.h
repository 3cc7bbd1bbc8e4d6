// Formulas of the input, such as "105*sin(pi*y/12)": muParser's syntax, the constants pi and e, and
// variables that depend on where the formula stands: the coordinates x, y, z of a point in m, the time t
// in s. The only door to muParser. Formulas may be evaluated by several threads; copies of one wait for each other.
#pragma once

#include <concepts>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "lib/config/values.h"
#include "lib/core/types.h"

namespace orthodyn {

class Formula {
 public:
  // Throws std::invalid_argument with muParser's complaint.
  Formula(const std::string& text, const std::vector<std::string>& variables, std::string where);
  const std::string& text() const { return text_; }
  bool uses(const std::string& variable) const;

 protected:
  // The values of the variables, in their order. Throws ConfigError where the result is not a number.
  double evaluate(const double* values) const;

 private:
  struct Parsed;
  std::string text_, where_;  // and its place in the input
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

// Throws ConfigError with what may be written; `known` are the variables.
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

}  // namespace orthodyn
