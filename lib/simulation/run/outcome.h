// The outcome of a computation: completed, interrupted or failed, with messages and the last state.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/errors.h"
#include "lib/simulation/output/observer.h"

namespace orthodyn {

struct Outcome {
  enum class Status { completed, interrupted, failed };
  Status status = Status::completed;
  std::string message;                     // of a failed run: what failed, where, what to try
  std::string remark;                      // of a completed run that an event stopped: the event
  Reason reason = Reason::other;           // of a failed run, for tables
  std::optional<double> may_pass_through;  // start of the first fixed step much longer than Model::longest_step(), s
  std::optional<double> stepped_over;      // start of the first step much longer than Model::step_limits() allows, s
  // Time of a change of a load or support motion that is too short for the step limits: StepLimits::unresolved(), s.
  std::optional<double> unresolved_change;
  State last;                 // the last state reached
  bool between_steps = true;  // false if an observer failed, so that not all observers have seen the last state
  double wall_seconds = 0, cpu_seconds = 0;
  Cost observation = {};  // see Statistics::observation
};

const char* status_word(Outcome::Status status);  // "completed"

// Processor time (s) since an arbitrary start: subtract two calls. The time is that of this thread if loops run on one
// thread, otherwise that of the process. The number of threads must not change between the two calls.
double cpu_seconds_now();

// Calls `work` with an outcome whose last state is `initial`, turns an exception into a failed outcome, and calls
// on_end() of the observers.
Outcome supervise(const State& initial, const std::vector<Observer*>& observers,
                  const std::function<void(Outcome&)>& work);

}  // namespace orthodyn
