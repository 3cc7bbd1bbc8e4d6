// Numbers by name, and formulas of them: what the texts "=formula" of a sweep stand for.
#pragma once

#include <string>
#include <vector>

#include "lib/config/config.h"

namespace orthodyn {

// Letters, digits and '_', no digit first.
bool is_identifier(const std::string& name);

// Throws ConfigError at `at` unless formulas can use the name: an identifier, not one of the constants e and pi.
void check_formula_name(const std::string& name, const Config& at);

class FormulaScope {
 public:
  void add(const std::string& name, double value);

  // Throws ConfigError at `where`, also for a result that is no number.
  double evaluate(const std::string& formula, const std::string& where) const;

  // A value of the input with each text "=formula" in it replaced by its number, as YAML.
  std::string resolved(const Config& value, const std::string& where) const;

 private:
  std::vector<std::string> names_;
  std::vector<double> values_;
};

// True if the formula has the name as a word.
bool mentions(const std::string& formula, const std::string& name);

}  // namespace orthodyn
