// A line on the terminal for each job of a study that is over, and how long the rest may take.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace orthodyn {

class ProgressReporter {
 public:
  // One that is `quiet` prints nothing.
  explicit ProgressReporter(bool quiet) : quiet_(quiet) {}

  // A cached job is known to take no time. `count`: of all jobs; it may change as the work goes on.
  void report(std::size_t count, const std::string& title, const std::string& outcome, bool cached);

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_;
  Clock::time_point began_ = Clock::now();
  std::size_t number_ = 0, worked_ = 0;
};

}  // namespace orthodyn
