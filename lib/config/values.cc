#include "lib/config/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "lib/core/parse_number.h"
#include "lib/core/ratio_distance.h"
#include "lib/core/units.h"

namespace orthodyn {

namespace {

// Throws unless the number is 0: degrees and radians are both common, so that a number alone is ambiguous.
double angle_without_unit(const Config& config) {
  const double x = config.number();
  if (x == 0) return x;
  config.fail(fmt::format("an angle needs a unit: give '{0} deg' or '{0} rad'", config.text()), InputFault::form);
}

bool is_number_in_quotes(const Config& config) {
  double x = 0;
  return config.is_quoted() && parse_number(config.text(), x);
}

double quantity(const Config& config, std::string_view unit) {
  if (unit == "rad" && config.reads_as_number()) return angle_without_unit(config);
  if (!config.is_scalar() || config.reads_as_number() || is_number_in_quotes(config) ||
      config.text().find_first_of("0123456789") == std::string::npos)
    return config.number();
  try {
    return quantity_in(config.text(), std::string(unit));
  } catch (const std::invalid_argument& e) {
    config.fail(e.what(), InputFault::form);
  }
}

struct WithUnit {
  std::string text, unit;
  double number, si;
};

// The nonzero entries of a list that have a unit.
std::vector<WithUnit> entries_with_units(const Config& list, const std::vector<double>& si) {
  std::vector<WithUnit> out;
  for (std::size_t i = 0; i < si.size(); ++i) {
    if (list.at(i).reads_as_number() || si[i] == 0) continue;
    const std::string text = list.at(i).text();
    if (const auto split = split_quantity(text); split && split->number != 0)
      out.push_back({text, split->unit, split->number, si[i]});
  }
  return out;
}

// The unit that x probably lacks: the neighbour's, or another one, such as MPa for 10800 next to 0.84 GPa.
std::string likely_unit(double x, const WithUnit& neighbour) {
  constexpr double kFar = 300, kNear = 30;
  constexpr std::array<std::pair<const char*, double>, 3> kOthers{{{"GPa", 1e9}, {"MPa", 1e6}, {"kPa", 1e3}}};
  if (ratio_distance(x, neighbour.number) < kFar || !neighbour.unit.ends_with("Pa")) return neighbour.unit;
  for (const auto& [unit, si] : kOthers)
    if (ratio_distance(x * si, neighbour.si) < kNear) return unit;
  return neighbour.unit;
}

// Refuses lists such as [10.8 GPa, 0.84, 0.46]: a number without a unit that is far from the SI values of all entries
// with a unit, and nearer to their numbers.
void refuse_missing_units(const Config& list, const std::vector<double>& si, std::string_view unit) {
  constexpr double kUnlike = 60;
  const auto others = entries_with_units(list, si);
  if (others.empty()) return;
  for (std::size_t i = 0; i < si.size(); ++i) {
    if (si[i] == 0 || !list.at(i).reads_as_number()) continue;
    const auto looks_forgotten = [&](const WithUnit& other) {
      return ratio_distance(si[i], other.si) >= kUnlike &&
             ratio_distance(si[i], other.number) < ratio_distance(si[i], other.si);
    };
    if (!std::ranges::all_of(others, looks_forgotten)) continue;
    const WithUnit& other = others.front();
    list.at(i).fail(fmt::format("unit missing: '{0}' is next to '{1}'; write '{0} {2}', or '{0} {3}' if you mean that",
                                list.at(i).text(), other.text, likely_unit(si[i], other), unit),
                    InputFault::form);
  }
}

// Refuses extreme values, so that products and squares of quantities stay finite.
void require_computable(const Config& config, double x, std::string_view unit) {
  constexpr double kSmallest = 1e-100, kLargest = 1e100;
  if (x == 0 || (std::abs(x) >= kSmallest && std::abs(x) <= kLargest)) return;
  config.fail(fmt::format("{} {} is out of range: its magnitude must be 0, or between {:.0e} and {:.0e}",
                          number_text(x), unit, kSmallest, kLargest));
}

}  // namespace

std::size_t index_of_word(const Config& config, const std::vector<std::string>& words) {
  const std::string given = config.text();
  const auto found = std::find(words.begin(), words.end(), given);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  config.fail(expected_one_of(words, given), InputFault::form);
}

double read_number(const Config& config, const Rule& rule) {
  const double x = quantity(config, rule.unit);
  if (!rule.range.contains(x))
    config.fail(fmt::format("must be {}{}{}, found {}", range_text(rule.range), rule.unit.empty() ? "" : " ", rule.unit,
                            number_text(x)));
  if (!rule.unit.empty()) require_computable(config, x, rule.unit);
  return x;
}

std::string number_text(double x) { return fmt::format("{}", x); }

std::vector<double> read_numbers(const Config& config, const Rule& rule, std::size_t count) {
  if (!config.is_sequence() || config.size() != count) config.fail_expected(fmt::format("a list of {} numbers", count));
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(read_number(config.at(i), rule));
  if (!rule.unit.empty()) refuse_missing_units(config, out, rule.unit);
  return out;
}

ValueSchema list_schema(ValueSchema item, std::size_t count, std::string words) {
  return {.kind = ValueSchema::Kind::list, .words = std::move(words), .items = {std::move(item)}, .count = count};
}

long read_integer(const Config& config, const Rule& rule, long low, long high) {
  const long i = config.integer();
  const double x = read_number(config, rule);
  if (x > static_cast<double>(high) || x < static_cast<double>(low))
    config.fail(fmt::format("must be in [{}, {}], found {}", low, high, config.shown()));
  return i;
}

ValueSchema Value<Vec3>::schema() { return list_schema(Value<double>::schema(), 3, "[x, y, z]"); }
Vec3 Value<Vec3>::read(const Config& c, const Rule& r) { return Eigen::Map<const Vec3>(read_numbers(c, r, 3).data()); }
std::string Value<Vec3>::yaml(const Vec3& x) {
  return fmt::format("[{}, {}, {}]", number_text(x[0]), number_text(x[1]), number_text(x[2]));
}

ValueSchema Value<Mat3>::schema() { return list_schema(Value<Vec3>::schema(), 3, "[[row], [row], [row]]"); }
Mat3 Value<Mat3>::read(const Config& c, const Rule& r) {
  if (!c.is_sequence() || c.size() != 3) c.fail_expected("three rows of three numbers");
  Mat3 m;
  for (int i = 0; i < 3; ++i) m.row(i) = Value<Vec3>::read(c.at(static_cast<std::size_t>(i)), r);
  return m;
}
std::string Value<Mat3>::yaml(const Mat3& m) {
  return "[" + Value<Vec3>::yaml(m.row(0)) + ", " + Value<Vec3>::yaml(m.row(1)) + ", " + Value<Vec3>::yaml(m.row(2)) +
         "]";
}

}  // namespace orthodyn
