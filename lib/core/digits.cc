#include "lib/core/digits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace orthodyn {

namespace {

constexpr int kFewest = 2, kMost = 7;

}  // namespace

std::string known_digits(double value, double relative_error) {
  if (!std::isfinite(value)) return fmt::format("{}", value);
  const double error = std::abs(relative_error);
  const bool told = std::isfinite(error) && error > 0;
  const int digits =
      told ? static_cast<int>(std::clamp(std::ceil(-std::log10(error)) + 1, double{kFewest}, double{kMost})) : kMost;
  const std::string rounded = fmt::format("{:.{}e}", value, digits - 1);
  const double number = std::strtod(rounded.c_str(), nullptr);
  const double size = std::abs(number);
  if (size != 0 && (size < 1e-4 || size >= 1e7)) return rounded;
  return fmt::format("{:.{}f}", number,
                     std::max(digits - 1 - (size == 0 ? 0 : static_cast<int>(std::floor(std::log10(size)))), 0));
}

}  // namespace orthodyn
