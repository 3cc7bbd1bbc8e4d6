// Wall time limit of a run: `over` becomes true at the first step or output after the limit. Pass `over` to run() as
// its interrupt.
#pragma once

#include <atomic>
#include <chrono>

#include "lib/simulation/output/observer.h"

namespace orthodyn::study {

class Deadline : public Observer {
 public:
  // `seconds`: wall time from now.
  explicit Deadline(double seconds)
      : end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}
  void on_step(const StepInfo&, const ObservedState&, const Integrator&) override { check(); }
  void on_output(const ObservedState&) override { check(); }  // load steps are outputs

  std::atomic<bool> over{false};

 private:
  using Clock = std::chrono::steady_clock;
  void check() {
    if (Clock::now() > end_) over = true;
  }
  Clock::time_point end_;
};

}  // namespace orthodyn::study
