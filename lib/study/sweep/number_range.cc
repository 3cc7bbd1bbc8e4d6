// Ranges of a variable: {from, to, count}.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lib/core/parse_number.h"
#include "lib/core/units.h"
#include "lib/study/sweep/variable.h"

namespace orthodyn {

namespace {

constexpr const char* kNameSentence =
    "Name in formulas, tables and plots; default the last key of the path, with the index of an entry (young.0).";

void check_range(const NumberRange& r, const Config& config) {
  if (r.scale == Scale::log && !(r.from.number > 0 && r.to.number > 0))
    config.fail("scale: log needs 'from' and 'to' above 0");
}

// Converts both ends to one unit: that of the section, otherwise that of `from`.
void settle_units(NumberRange& r, const Config& c) {
  check_unit(r.unit, c);
  if (r.unit.empty() && r.from.unit.empty() != r.to.unit.empty())
    c.fail("only one of 'from' and 'to' has a unit; give one to both, or give 'unit'");
  if (r.unit.empty()) r.unit = r.from.unit;
  const auto settle = [&](Amount& a, const char* key) {
    if (a.unit.empty()) return;
    const auto number = number_in(c.at(key).text(), r.unit);
    if (!number) c.at(key).fail("expected a quantity that has the unit " + r.unit + ", found " + c.at(key).shown());
    a = {*number, r.unit};
  };
  settle(r.from, "from");
  settle(r.to, "to");
  if (r.from.number == r.to.number) c.at("to").fail("is equal to 'from'");
}

}  // namespace

const Spec<NumberRange>& NumberRange::spec() {
  static const auto s =
      Spec<NumberRange>()
          .key("from", &NumberRange::from, "The first value.", {.required = true})
          .key("to", &NumberRange::to, "The last value.", {.required = true})
          .key("count", &NumberRange::count, "Number of values including both ends; not for a Latin hypercube.",
               {.range = {1, 1e6}})
          .key("scale", &NumberRange::scale, "log: values with a constant ratio and logarithmic axes.")
          .key("unit", &NumberRange::unit,
               "Unit of the values, such as deg or GPa; 'from' and 'to' may have their own units instead. Formulas use "
               "SI units.")
          .key("name", &NumberRange::name, kNameSentence)
          .check(check_range);
  return s;
}

const Spec<ValueList>& ValueList::spec() {
  static const auto s =
      Spec<ValueList>()
          .key("values", &ValueList::values, "The values.", {.required = true})
          .key("unit", &ValueList::unit,
               "Unit of the numbers, such as deg or GPa; they may have their own units instead. Formulas use SI units.")
          .key("name", &ValueList::name, kNameSentence);
  return s;
}

void check_unit(const std::string& unit, const Config& at) {
  if (unit.empty()) return;
  try {
    si_factor(unit);
  } catch (const std::invalid_argument& e) {
    at.fail(e.what());
  }
}

std::optional<double> number_in(const std::string& text, const std::string& unit) {
  const auto parts = split_quantity(text);
  if (!parts) return {};
  if (parts->unit == unit) return parts->number;
  try {
    return quantity_in(text, unit);
  } catch (const std::invalid_argument&) {
    return {};
  }
}

NumberRange read_number_range(const Config& c) {
  NumberRange r = NumberRange::spec().read(c);
  settle_units(r, c);
  return r;
}

double range_at(const NumberRange& r, double share) {
  if (share == 0) return r.from.number;
  if (share == 1) return r.to.number;
  const double from = r.from.number, to = r.to.number;
  const double x = r.scale == Scale::log ? from * std::pow(to / from, share) : from + (to - from) * share;
  if (std::abs(x) < 1e-12 * std::max(std::abs(from), std::abs(to))) return 0;
  // Round to 12 digits, so that labels show 0.3 and not 0.30000000000000004.
  double simple = x;
  parse_number(fmt::format("{:.12g}", x), simple);
  return simple;
}

Amount Value<Amount>::read(const Config& c, const Rule&) {
  if (!c.is_scalar() || c.reads_as_number()) return {c.number(), ""};
  const auto parts = split_quantity(c.text());
  if (!parts) return {c.number(), ""};  // fails with what is expected
  check_unit(parts->unit, c);
  return {parts->number, parts->unit};
}

}  // namespace orthodyn
