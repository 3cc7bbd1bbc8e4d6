#include "lib/core/units.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace orthodyn {

namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
// Guards the parser of UDUNITS-2, which has global state.
std::recursive_mutex& udunits() {
  static std::recursive_mutex mutex;
  return mutex;
}

using Unit = std::unique_ptr<ut_unit, FreeUnit>;
using Converter = std::unique_ptr<cv_converter, FreeConverter>;

using Dimension = std::pair<const char*, const char*>;  // SI unit, word
constexpr auto kDimensions = std::to_array<Dimension>({{"m", "length"},
                                                       {"s", "time"},
                                                       {"kg", "mass"},
                                                       {"Pa", "stress or stiffness"},
                                                       {"kg/m^3", "density"},
                                                       {"m/s", "velocity"},
                                                       {"m/s^2", "acceleration"},
                                                       {"N", "force"},
                                                       {"rad", "angle"},
                                                       {"rad/s", "angular velocity"},
                                                       {"1/s", "rate"},
                                                       {"J", "energy"},
                                                       {"m^2", "area"},
                                                       {"m^3", "volume"}});

// The unit system, read from the files of UDUNITS-2 at first use and never freed.
ut_system* units() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    ut_system* read = ut_read_xml(nullptr);
    if (!read)
      throw std::runtime_error(
          "the unit table of UDUNITS-2 cannot be read (Debian: libudunits2-data); give plain numbers in SI units");
    Unit degree(ut_get_unit_by_name(read, "degree"));
    ut_map_name_to_unit("deg", UT_ASCII, degree.get());  // UDUNITS keeps a copy
    return read;
  }();
  return system;
}

Unit parse(const std::string& text) { return Unit(ut_parse(units(), text.c_str(), UT_UTF8)); }

// A unit written in base units: "kg.m-1.s-2" for the pascal.
std::string base_units(const ut_unit* unit) {
  std::array<char, 200> text{};
  const int length = ut_format(unit, text.data(), text.size(), UT_ASCII | UT_DEFINITION);
  return length < 0 ? "" : std::string(text.data(), static_cast<std::size_t>(length));
}

// Whether a unit contains an angle. UDUNITS treats a radian as the number one.
bool has_angle(const ut_unit* unit) { return base_units(unit).find("rad") != std::string::npos; }

// Whether two units convert into each other. UDUNITS would also convert between reciprocals, such as time and
// frequency.
bool same_dimension(const ut_unit* a, const ut_unit* b) {
  const Unit ratio(ut_divide(a, b));
  return ratio && ut_is_dimensionless(ratio.get()) != 0 && has_angle(a) == has_angle(b);
}

// True for dimensionless units other than angles: "%", "ppm".
bool is_ratio(const ut_unit* unit) { return ut_is_dimensionless(unit) != 0 && !has_angle(unit); }

double size_of_ratio(const ut_unit* unit) {
  const Unit one(ut_get_dimensionless_unit_one(units()));
  const Converter converter(ut_get_converter(const_cast<ut_unit*>(unit), one.get()));
  return converter ? cv_convert_double(converter.get(), 1) : NAN;
}

// True for "GPa 3", which UDUNITS would accept as a unit.
bool has_factor(const std::string& unit) {
  for (std::size_t i = 0; i < unit.size(); ++i)
    if (unit[i] >= '0' && unit[i] <= '9' && (i == 0 || unit[i - 1] == ' ')) return true;
  return false;
}

// `unit`: what follows the number; ",8 GPa" for "10,8 GPa".
bool is_decimal_comma(const std::string& unit) {
  return unit.size() > 1 && unit[0] == ',' && std::isdigit(static_cast<unsigned char>(unit[1])) != 0;
}

// "; did you mean 'GPa'?" for an unknown unit that differs from a common one only in its capitals.
std::string other_capitals(const std::string& unknown) {
  constexpr const char* kCommon[] = {"GPa", "MPa", "kPa", "Pa", "mm", "cm",  "km",  "m",  "ms",
                                     "s",   "kg",  "kN",  "MN", "N",  "kHz", "MHz", "Hz", "kg/m^3"};
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  for (const std::string common : kCommon)
    if (std::ranges::equal(unknown, common, same)) return fmt::format("; did you mean '{}'?", common);
  return "";
}

// "length (m)" for a unit given by the user.
std::string describe(const ut_unit* unit) {
  for (const auto& [known, word] : kDimensions)
    if (same_dimension(unit, parse(known).get())) return fmt::format("{} ({})", word, known);
  return "quantity of dimension " + base_units(unit);
}

std::string with_article(const std::string& words) {
  return (std::string("aeiou").find(words.front()) == std::string::npos ? "a " : "an ") + words;
}

std::string expected(const std::string& unit) {
  if (unit.empty()) return "a plain number";
  return with_article(dimension_text(unit));
}

}  // namespace

std::optional<NumberWithUnit> split_quantity(const std::string& text) {
  double number = 0;
  const char *begin = text.data(), *end = begin + text.size();
  while (begin != end && *begin == ' ') ++begin;
  if (end - begin > 1 && begin[0] == '+' && begin[1] != '-') ++begin;  // from_chars refuses a plus sign
  const auto [rest, error] = std::from_chars(begin, end, number);
  std::string name(rest, end);
  name.erase(0, name.find_first_not_of(' '));
  name.erase(name.find_last_not_of(' ') + 1);
  if (error != std::errc{} || !std::isfinite(number) || name.empty()) return {};
  return NumberWithUnit{number, name};
}

double quantity_in(const std::string& text, const std::string& unit) {
  const std::lock_guard lock(udunits());
  const auto fail = [&](const std::string& found) {
    throw std::invalid_argument(fmt::format("expected {}, found {}", expected(unit), found));
  };
  const auto parts = split_quantity(text);
  if (!parts) fail("'" + text + "'");
  const auto& [number, name] = *parts;
  if (is_decimal_comma(name)) {
    std::string with_point = text;
    with_point[text.find(',')] = '.';
    fail(fmt::format("'{}', with a decimal comma; write '{}'", text, with_point));
  }
  const Unit given = has_factor(name.starts_with("1/") ? name.substr(2) : name) ? Unit() : parse(name);
  if (!given) fail(fmt::format("'{}': the unit '{}' is not known{}", text, name, other_capitals(name)));
  if (unit.empty() && is_ratio(given.get()))
    fail(fmt::format("'{}': the unit {} is not allowed here; write {:.6g}, or {:.6g} if the quantity is in per cent",
                     text, name, number * size_of_ratio(given.get()), 100 * number * size_of_ratio(given.get())));
  if (unit.empty()) fail(fmt::format("'{}', {}", text, with_article(describe(given.get()))));
  const Unit wanted = parse(unit);
  if (!wanted) fail(fmt::format("'{}'; give a plain number", text));  // for example bytes, which UDUNITS does not know
  const bool fits = same_dimension(given.get(), wanted.get());
  if (!fits && is_ratio(given.get())) fail(fmt::format("'{}': the unit {} is not allowed here", text, name));
  if (!fits) fail(fmt::format("'{}', {}", text, with_article(describe(given.get()))));
  const Converter converter(ut_get_converter(given.get(), wanted.get()));
  const double value = converter ? cv_convert_double(converter.get(), number) : NAN;
  if (!std::isfinite(value)) fail("'" + text + "', which is too large");
  return value;
}

double si_factor(const std::string& unit) {
  const std::lock_guard lock(udunits());
  const Unit given = has_factor(unit.starts_with("1/") ? unit.substr(2) : unit) ? Unit() : parse(unit);
  if (given)
    for (const auto& [known, word] : kDimensions)
      if (same_dimension(given.get(), parse(known).get())) return quantity_in("1 " + unit, known);
  throw std::invalid_argument("the unit '" + unit + "' is not known");
}

void check_dimension(const std::string& unit, const std::string& si) {
  const std::lock_guard lock(udunits());
  si_factor(unit);
  const std::string wanted = si == "1" ? "" : si;
  try {
    quantity_in("1 " + unit, wanted);
  } catch (const std::invalid_argument&) {
    const Unit given = parse(unit);
    throw std::invalid_argument(fmt::format("expected {}, found the unit '{}'{}", expected(wanted), unit,
                                            given ? ", " + with_article(describe(given.get())) : ""));
  }
}

std::string dimension_text(const std::string& unit) {
  for (const auto& [known, word] : kDimensions)
    if (unit == known) return fmt::format("{} ({})", word, unit);
  return unit == "Hz" ? "frequency (Hz)" : unit;
}

}  // namespace orthodyn
