// How a computation has ended.
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
  std::string message;                 // of a failure: what, where, what to try
  std::string remark;                  // of a run that was completed before its end: which event it was
  Reason reason = Reason::other;       // of a failure, for tables
  std::optional<double> stepped_over;  // s: the start of a step that is too long for what a load does in it
  std::optional<double> unresolved;    // s: where a load or a motion changes too fast to be looked at beforehand
  State last;                          // the last state reached
  bool between_steps = true;           // false: an observer failed, and not all have seen the last state
  double wall_seconds = 0, cpu_seconds = 0;
  Cost observation = {};  // of a motion, as in Statistics
};

const char* status_word(Outcome::Status status);  // "completed"

// Processor time, s, of which differences count: of this thread where its loops run on one, else of the process.
// Between the two of a difference the number of threads is the same.
double cpu_seconds_now();

// Calls `work`, turns the exception that stops it into the outcome, and calls on_end of the observers.
Outcome supervise(const State& initial, const std::vector<Observer*>& observers,
                  const std::function<void(Outcome&)>& work);

}  // namespace orthodyn
