#include "lib/core/values.h"

#include <cmath>

namespace orthodyn {

std::string range_text(const Range& r) {
  const bool low = std::isfinite(r.low), high = std::isfinite(r.high);
  if (low && high)
    return fmt::format("in {}{}, {}{}", r.low_open ? '(' : '[', r.low, r.high,
                       r.high_open ? ')' : ']');
  if (low) return fmt::format("{} {}", r.low_open ? ">" : ">=", r.low);
  if (high) return fmt::format("{} {}", r.high_open ? "<" : "<=", r.high);
  return "";
}

double read_number(const Config& config, const Rule& rule) {
  const double x = config.number();
  if (!rule.range.contains(x))
    config.fail(fmt::format("must be {}{}{}, found {}", range_text(rule.range),
                            rule.unit.empty() ? "" : " ", rule.unit, number_text(x)));
  return x;
}

std::string number_text(double x) { return fmt::format("{}", x); }

std::vector<double> read_numbers(const Config& config, const Rule& rule, std::size_t count) {
  if (!config.is_sequence() || config.size() != count)
    config.fail(fmt::format("expected a list of {} numbers, found {}", count, config.shown()));
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(read_number(config.at(i), rule));
  return out;
}

}  // namespace orthodyn
