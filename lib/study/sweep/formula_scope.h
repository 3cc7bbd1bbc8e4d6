// Named numbers and the evaluation of formulas that use them, for the texts "=formula" in a sweep's file.
#pragma once

#include <string>
#include <vector>

#include "lib/config/config.h"

namespace orthodyn {

// True for a name of letters, digits and '_' that does not start with a digit.
bool is_identifier(const std::string& name);

// Throws ConfigError at `at` unless the name is an identifier and not one of the constants e and pi.
void check_formula_name(const std::string& name, const Config& at);

class FormulaScope {
 public:
  void add(const std::string& name, double value);

  // Throws ConfigError at `where` for an invalid formula or a result that is not finite.
  double evaluate(const std::string& formula, const std::string& where) const;

  // The value as YAML, with each text "=formula" replaced by its number.
  std::string resolved(const Config& value, const std::string& where) const;

 private:
  std::vector<std::string> names_;
  std::vector<double> values_;
};

// True if the formula contains the name as a whole word.
bool mentions(const std::string& formula, const std::string& name);

}  // namespace orthodyn
