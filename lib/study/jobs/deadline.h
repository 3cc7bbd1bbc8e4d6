// Ends a run that takes too long, after the step in progress: run() looks at `over` as its interrupt.
#pragma once

#include <atomic>
#include <chrono>

#include "lib/simulation/output/observer.h"

namespace orthodyn::study {

class Deadline : public Observer {
 public:
  // `seconds` of wall time from now on.
  explicit Deadline(double seconds)
      : end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}
  void on_step(const StepInfo&, const ObservedState&, const Integrator&) override { look(); }
  void on_output(const ObservedState&) override { look(); }  // the steps of a static analysis

  std::atomic<bool> over{false};

 private:
  using Clock = std::chrono::steady_clock;
  void look() {
    if (Clock::now() > end_) over = true;
  }
  Clock::time_point end_;
};

}  // namespace orthodyn::study
