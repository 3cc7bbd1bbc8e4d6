// The state of a run at one time: the last that was seen up to it.
#pragma once

#include <optional>

#include "lib/simulation/output/observer.h"

namespace orthodyn {

class Snapshot : public Observer {
 public:
  // Of the end, without a time. A time within the run must be among its output times.
  explicit Snapshot(std::optional<double> at) : at_(at) {}
  void on_start(const ObservedState& observed) override { state_ = observed.state(); }
  void on_output(const ObservedState& observed) override { keep(observed.state()); }
  void on_step(const StepInfo&, const ObservedState& observed, const Integrator&) override { keep(observed.state()); }

  const State& state() const { return state_; }

 private:
  void keep(const State& s) {
    if ((!at_ || s.t <= *at_) && s.t > state_.t) state_ = s;
  }

  std::optional<double> at_;
  State state_;
};

}  // namespace orthodyn
