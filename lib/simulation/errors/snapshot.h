// The state of a run at one time: the last that was seen up to it.
#pragma once

#include <optional>

#include "lib/simulation/observers/observer.h"

namespace orthodyn {

class Snapshot : public Observer {
 public:
  // Of the end, without a time. A time within the run must be among its output times.
  explicit Snapshot(std::optional<double> at) : at_(at) {}
  void on_start(const State& s) override { state_ = s; }
  void on_output(const State& s) override { keep(s); }
  void on_step(const StepInfo&, const State& s, const Integrator&) override { keep(s); }

  const State& state() const { return state_; }

 private:
  void keep(const State& s) {
    if ((!at_ || s.t <= *at_) && s.t > state_.t) state_ = s;
  }

  std::optional<double> at_;
  State state_;
};

}  // namespace orthodyn
