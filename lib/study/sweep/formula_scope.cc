#include "lib/study/sweep/formula_scope.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "lib/config/formula.h"

namespace orthodyn {

namespace {

class NamedFormula : public Formula {
 public:
  using Formula::Formula;
  double at(const std::vector<double>& values) const { return evaluate(values.data()); }
};

bool is_name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

}  // namespace

bool is_identifier(const std::string& name) {
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front()))) return false;
  return std::all_of(name.begin(), name.end(), is_name_character);
}

void check_formula_name(const std::string& name, const Config& at) {
  if (!is_identifier(name))
    at.fail("the name '" + name +
            "' cannot be used in formulas: a name consists of letters, digits and '_', no digit first");
  if (name == "e" || name == "pi")
    at.fail("the name '" + name + "' is a constant in formulas; choose another (for a varied key: 'name')");
}

void FormulaScope::add(const std::string& name, double value) {
  names_.push_back(name);
  values_.push_back(value);
}

double FormulaScope::evaluate(const std::string& formula, const std::string& where) const {
  try {
    return NamedFormula(formula, names_, where).at(values_);
  } catch (const std::invalid_argument& e) {
    throw ConfigError(
        where, fmt::format("cannot read the formula '{}': {} Known: {}, pi, e, and functions such as sin, exp, sqrt.",
                           formula, e.what(), join(names_)));
  }
}

std::string FormulaScope::resolved(const Config& value, const std::string& where) const {
  std::vector<std::string> parts;
  if (value.is_sequence()) {
    for (std::size_t i = 0; i < value.size(); ++i) parts.push_back(resolved(value.at(i), where));
    return "[" + join(parts) + "]";
  }
  if (value.is_map()) {
    for (const auto& key : value.keys()) parts.push_back(key + ": " + resolved(value.at(key), where));
    return "{" + join(parts) + "}";
  }
  if (!value.is_scalar() || !value.text().starts_with("=")) return value.yaml();
  return number_text(evaluate(value.text().substr(1), where));
}

bool mentions(const std::string& formula, const std::string& name) {
  for (std::size_t at = formula.find(name); at != std::string::npos; at = formula.find(name, at + 1)) {
    const auto end = at + name.size();
    if ((at == 0 || !is_name_character(formula[at - 1])) && (end == formula.size() || !is_name_character(formula[end])))
      return true;
  }
  return false;
}

}  // namespace orthodyn
