#include "tools/orthodyn/failure_summary.h"

#include <fmt/format.h>

#include <cstdio>

namespace orthodyn {

void FailureSummary::add(const std::string& title, const std::optional<study::Failure>& failure) {
  ++count_;
  if (failure && ++failed_ == 1) first_ = title + ": " + failure->reason + ": " + failure->message;
}

void FailureSummary::print() const {
  if (failed_ > 0) fmt::print(stderr, "{} of {} points failed; the first, {}\n", failed_, count_, first_);
}

void tell_of_kept_limits(std::size_t count) {
  if (count > 0)
    fmt::print(stderr,
               "kept from an earlier run: {} that reached the limit of time or memory; --retry repeats what failed\n",
               count);
}

}  // namespace orthodyn
