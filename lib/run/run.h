// Drives one integration from start to end: steps, output times, breakpoints, observers.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/errors.h"
#include "lib/run/observer.h"

namespace orthodyn {

struct Plan {
  double end = 0;                    // s
  std::vector<double> output_times;  // ascending, after the start
  bool exact_times = false;          // steps end on output times
  // The run goes on from a checkpoint: outputs up to this time have been delivered.
  std::optional<double> delivered = std::nullopt;
};

// `frames` + 1 evenly spaced times including both ends, resp. multiples of an interval; the start is
// left out.
std::vector<double> evenly_spaced(double start, double end, int frames);
std::vector<double> by_interval(double start, double end, double interval);

struct Outcome {
  enum class Status { completed, interrupted, failed };
  Status status = Status::completed;
  std::string message;            // of a failure: what, where, what to try
  Reason reason = Reason::other;  // of a failure, for tables
  State last;                     // the last state reached
  bool between_steps = true;      // false: an observer failed, and not all have seen the last state
  double wall_seconds = 0, cpu_seconds = 0;
};

// Processor time of this process, s.
double cpu_seconds_now();

// Never throws for a computation that could not go on: that is an Outcome. Observers are told of the
// end in every case. A resumed run calls on_resume in place of on_start. `interrupt` is looked at after each step.
Outcome run(const Model& model, Integrator& integrator, const State& initial, const Plan& plan,
            const std::vector<Observer*>& observers, const std::atomic<bool>& interrupt);

}  // namespace orthodyn
