#include "lib/core/number_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace orthodyn {

std::string known_digits(double value, double relative_error) {
  constexpr int kFewest = 2, kMost = 7;
  if (!std::isfinite(value)) return fmt::format("{}", value);
  const double error = std::abs(relative_error);
  const bool is_known = std::isfinite(error) && error > 0;
  const int digits =
      is_known ? static_cast<int>(std::clamp(std::ceil(-std::log10(error)) + 1, double{kFewest}, double{kMost}))
               : kMost;
  const std::string rounded = fmt::format("{:.{}e}", value, digits - 1);
  const double number = std::strtod(rounded.c_str(), nullptr);
  const double size = std::abs(number);
  if (size != 0 && (size < 1e-4 || size >= 1e7)) return rounded;
  return fmt::format("{:.{}f}", number,
                     std::max(digits - 1 - (size == 0 ? 0 : static_cast<int>(std::floor(std::log10(size)))), 0));
}

std::string duration_text(double seconds) {
  const double whole = std::round(seconds);  // before splitting: 119.7 s are 2 min 0 s, not 1 min 60 s
  if (whole < 60) return fmt::format("{:.0f} s", whole);
  if (whole < 3600) return fmt::format("{:.0f} min {:.0f} s", std::floor(whole / 60), std::fmod(whole, 60));
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace orthodyn
