#include "tools/orthodyn/time_left.h"

#include <fmt/format.h>

namespace orthodyn {

void TimeLeft::begin() {
  if (begun_++ == done_) began_ = Clock::now();  // nothing else is going on
}

std::string TimeLeft::after_one(std::size_t remaining) {
  const auto now = Clock::now();
  spent_ += std::chrono::duration<double>(now - began_).count();
  began_ = now;
  const double left = spent_ / static_cast<double>(++done_) * static_cast<double>(remaining);
  if (left >= 60) return fmt::format("  ({:.0f} min left)", left / 60);
  return left >= 5 ? fmt::format("  ({:.0f} s left)", left) : "";
}

}  // namespace orthodyn
