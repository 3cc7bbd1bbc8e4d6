// Drives one integration: steps, output times, breakpoints, events, observers.
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
  bool exact_times = false;               // steps end at output times
  // Set for a resumed run: time up to which outputs have been delivered, s.
  std::optional<double> delivered = std::nullopt;
  EventFinder* events = nullptr;           // null without events
  std::vector<double> history_times = {};  // ascending, after the start; empty: the output times
  double history_delivered = 0;            // as `delivered`, for the history, s
  bool history_at_steps = false;           // record the history after each step instead of at history_times
};

// `frames` evenly spaced times up to the end; the start is excluded.
std::vector<double> evenly_spaced(double start, double end, int frames);
// The times start + k interval (k = 1, 2, ...) before the end, and the end itself.
std::vector<double> by_interval(double start, double end, double interval);

// Returns an Outcome also if the computation fails; does not throw. Always calls on_end() of the observers; a resumed
// run calls on_resume() instead of on_start(). `interrupt` is read before each step.
Outcome run(const Model& model, Integrator& integrator, const State& initial, const Plan& plan,
            const std::vector<Observer*>& observers, const std::atomic<bool>& interrupt);

}  // namespace orthodyn
