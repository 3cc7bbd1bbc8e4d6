// Quantities with a unit, such as "11.9 GPa", by UDUNITS-2 (SI units with prefixes, inch, psi, degree, ...).
#pragma once

#include <optional>
#include <string>

namespace orthodyn {

// The value of `text` in `unit` (SI, such as "Pa" or "kg/m^3"; "" for a key without a unit). Angles count as a
// dimension, so that Hz does not convert to rad/s. Throws std::invalid_argument with what was found and what is
// expected.
double quantity_in(const std::string& text, const std::string& unit);

// Splits "10 MPa" into number and word, whether or not the word is a unit. Empty if the text has another form.
struct NumberWithUnit {
  double number;
  std::string unit;
};
std::optional<NumberWithUnit> split_quantity(const std::string& text);

// The factor from `unit` to SI: 1e9 for "GPa", 0.0175 for "deg". Throws std::invalid_argument for an unknown unit.
double si_factor(const std::string& unit);

// Throws std::invalid_argument unless `unit` is known and has the dimension of `si` ("" for a plain number).
void check_dimension(const std::string& unit, const std::string& si);

// "stress or stiffness (Pa)"; the unit alone if its dimension has no name.
std::string dimension_text(const std::string& unit);

}  // namespace orthodyn
