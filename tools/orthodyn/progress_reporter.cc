#include "tools/orthodyn/progress_reporter.h"

#include <fmt/format.h>

#include <cstdio>

namespace orthodyn {

void ProgressReporter::report(std::size_t count, const std::string& title, const std::string& outcome, bool cached) {
  if (quiet_) return;
  ++number_;
  fmt::print("[{:>{}}/{}] {}: {}", number_, std::to_string(count).size(), count, title, outcome);
  if (cached) {
    fmt::print(" (done before)");
  } else {
    const double spent = std::chrono::duration<double>(Clock::now() - began_).count();
    const double left = spent / static_cast<double>(++worked_) * static_cast<double>(count - number_);
    if (left >= 60) fmt::print("  ({:.0f} min left)", left / 60);
    else if (left >= 5) fmt::print("  ({:.0f} s left)", left);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

}  // namespace orthodyn
