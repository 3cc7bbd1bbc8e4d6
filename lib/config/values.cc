#include "lib/config/values.h"

#include <algorithm>
#include <stdexcept>

#include "lib/core/units.h"

namespace orthodyn {

namespace {

double quantity(const Config& config, std::string_view unit) {
  if (!config.is_scalar() || config.reads_as_number() || config.text().find_first_of("0123456789") == std::string::npos)
    return config.number();
  try {
    return quantity_in(config.text(), std::string(unit));
  } catch (const std::invalid_argument& e) {
    config.fail(e.what(), InputFault::form);
  }
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
    config.fail(fmt::format("must be {}{}{}, found {}", range_text(rule.range),
                            rule.unit.empty() ? "" : " ", rule.unit, number_text(x)));
  return x;
}

std::string number_text(double x) { return fmt::format("{}", x); }

std::vector<double> read_numbers(const Config& config, const Rule& rule, std::size_t count) {
  if (!config.is_sequence() || config.size() != count)
    config.fail(fmt::format("expected a list of {} numbers, found {}", count, config.shown()), InputFault::form);
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(read_number(config.at(i), rule));
  return out;
}

}  // namespace orthodyn
