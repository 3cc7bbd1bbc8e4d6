// Ends a run that takes too long, after the step in progress: run() looks at `over` as its interrupt.
#pragma once

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <string>

#include "lib/simulation/observer.h"

namespace orthodyn {

// The reason of such an end, in tables.
inline constexpr const char* kTimeLimit = "time limit";

// What is said of a run that was ended so.
inline std::string too_late(double seconds, double time_reached) {
  return fmt::format("reached t = {:.4g} in the {:g} s of wall time that it may take; raise limits.seconds, or ask for less",
                     time_reached, seconds);
}

class Deadline : public Observer {
 public:
  explicit Deadline(double seconds)
      : end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}
  void on_step(const StepInfo&, const State&, const Integrator&) override { look(); }
  void on_output(const State&) override { look(); }  // the steps of a static analysis

  std::atomic<bool> over{false};

 private:
  using Clock = std::chrono::steady_clock;
  void look() {
    if (Clock::now() > end_) over = true;
  }
  Clock::time_point end_;
};

}  // namespace orthodyn
