// Quantities with a unit, such as "11.9 GPa". The only door to UDUNITS-2, whose names are understood
// (SI units with prefixes, inch, psi, degree, ...).
#pragma once

#include <optional>
#include <string>

namespace orthodyn {

// The number that `text` stands for in `unit` (SI, such as "Pa" or "kg/m^3"; "" for a key without one).
// An angle is a dimension of its own: Hz is no rad/s. Throws std::invalid_argument with a sentence that
// names what was found and what is expected.
double quantity_in(const std::string& text, const std::string& unit);

// "10 MPa" taken apart, whether or not there is such a unit; nothing for what is no number followed by a word.
struct NumberWithUnit {
  double number;
  std::string unit;
};
std::optional<NumberWithUnit> split_quantity(const std::string& text);

// What one of a unit is in SI units: 1e9 for "GPa", 0.0175 for "deg". Throws std::invalid_argument for a unit that is
// not known.
double si_factor(const std::string& unit);

// Throws std::invalid_argument unless `unit` is known and measures what `si` does; "" is a plain number.
void check_dimension(const std::string& unit, const std::string& si);

// "stress or stiffness (Pa)"; the unit alone where there is no word for it.
std::string dimension_text(const std::string& unit);

}  // namespace orthodyn
