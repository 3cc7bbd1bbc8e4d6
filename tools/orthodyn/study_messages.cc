#include "tools/orthodyn/study_messages.h"

#include <fmt/format.h>

#include <cstdio>

#include "lib/core/spelling.h"

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

void FailureSummary::add(const std::string& title, const std::optional<study::Failure>& failure) {
  ++count_;
  if (failure && ++failed_ == 1) first_ = title + ": " + failure->reason + ": " + failure->message;
}

void FailureSummary::print() const {
  if (failed_ > 0) fmt::print(stderr, "{} of {} points failed; first: {}\n", failed_, count_, first_);
}

void print_kept_failures(std::size_t count) {
  if (count > 0)
    fmt::print(stderr, "kept {} of an earlier run at the limit of time or memory; --retry repeats all failures\n",
               counted(static_cast<long>(count), "failure"));
}

void print_interrupted(const char* pieces, const std::filesystem::path& folder) {
  fmt::print(stderr, "interrupted; the finished {} are kept in {}; run the same command again to continue\n", pieces,
             folder.string());
}

}  // namespace orthodyn
