#include "lib/core/duration.h"

#include <fmt/format.h>

#include <cmath>

namespace orthodyn {

std::string duration_text(double seconds) {
  const double whole = std::round(seconds);  // first: 119.7 s are 2 min 0 s, not 1 min 60 s
  if (whole < 60) return fmt::format("{:.0f} s", whole);
  if (whole < 3600) return fmt::format("{:.0f} min {:.0f} s", std::floor(whole / 60), std::fmod(whole, 60));
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace orthodyn
