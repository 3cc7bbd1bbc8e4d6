// What failed in a study, told at its end.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "lib/study/jobs/job_result.h"

namespace orthodyn {

class FailureSummary {
 public:
  // A point that was completed, or has failed.
  void add(const std::string& title, const std::optional<study::Failure>& failure);

  // How many failed, and what the first of them says. Nothing if none did.
  void print() const;

  // 3 if nothing was computed, else 0: single failures are results.
  int exit_code() const { return failed_ > 0 && failed_ == count_ ? 3 : 0; }

 private:
  std::size_t count_ = 0, failed_ = 0;
  std::string first_;
};

// That this many failures at a limit of time or memory were kept, and what does them again.
void tell_of_kept_limits(std::size_t count);

}  // namespace orthodyn
