// Drives one integration from start to end: steps, output times, breakpoints, observers.
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "lib/simulation/output/event_finder.h"
#include "lib/simulation/run/outcome.h"

namespace orthodyn {

struct Plan {
  double end = 0;                         // s
  std::vector<double> output_times = {};  // ascending, after the start
  bool exact_times = false;               // steps end on output times
  // The run goes on from a checkpoint: outputs up to this time have been delivered.
  std::optional<double> delivered = std::nullopt;
  EventFinder* events = nullptr;           // finds events in each step; null without events
  std::vector<double> history_times = {};  // ascending, after the start; the output times where it is empty
  double history_delivered = 0;            // with `delivered`: the same of the history
  bool history_at_steps = false;           // in place of history_times: after each step
};

// `frames` evenly spaced times; the last is the end, the start is left out.
std::vector<double> evenly_spaced(double start, double end, int frames);
// Multiples of an interval after the start, and the end.
std::vector<double> by_interval(double start, double end, double interval);

// A computation that cannot continue is an Outcome, not an exception. Observers get on_end() in every case, and
// on_resume() in place of on_start() in a resumed run. `interrupt` is read after each step.
Outcome run(const Model& model, Integrator& integrator, const State& initial, const Plan& plan,
            const std::vector<Observer*>& observers, const std::atomic<bool>& interrupt);

}  // namespace orthodyn
