#include "lib/study/fit/headings.h"

#include <fmt/format.h>

#include <stdexcept>

#include "lib/core/units.h"

namespace orthodyn::study::fit {

std::string unit_in(const std::string& heading) {
  const auto open = heading.rfind('['), close = heading.rfind(']');
  if (open == std::string::npos || close == std::string::npos || close < open) return "";
  return heading.substr(open + 1, close - open - 1);
}

std::string name_in(const std::string& heading) {
  const std::string name = heading.substr(0, heading.rfind('['));
  return name.substr(0, name.find_last_not_of(' ') + 1);
}

double factor_of(const std::string& unit, const std::string& si, const SourceLocation& origin) {
  if (unit.empty()) return 1;
  try {
    check_dimension(unit, si);
    return si_factor(unit);
  } catch (const std::invalid_argument& e) {
    origin.fail(fmt::format("unit '{}': {}", unit, e.what()));
  }
}

}  // namespace orthodyn::study::fit
