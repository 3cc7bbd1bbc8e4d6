// Shows how far a run has come: one line that is renewed on a terminal, else a line every few seconds.
#pragma once

#include <chrono>
#include <cstdio>

#include "lib/simulation/output/observer.h"

namespace orthodyn {

class TerminalProgress : public Observer {
 public:
  TerminalProgress(double start, double end, std::FILE* out);
  void on_resume(const ObservedState& observed) override { from_ = observed.t(); }
  void on_step(const StepInfo& info, const ObservedState&, const Integrator&) override;
  void on_end() noexcept override;

 private:
  using Clock = std::chrono::steady_clock;
  void show(const StepInfo& info, double elapsed);

  double start_, end_, from_;  // of the run, and of this process
  std::FILE* out_;
  bool terminal_, shown_ = false;
  Clock::time_point begin_, last_;
};

}  // namespace orthodyn
