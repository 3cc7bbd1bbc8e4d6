// Finds the times at which quantities pass values, on the dense output of any integrator.
//
// Each step is sampled at its end and at three interior times. Where quantity - value changes sign between two samples,
// the root is found to round-off (algorithm 748; Alefeld, Potra & Shi 1995). Two crossings between the same two samples
// are missed. If a quantity equals the value at the start, it must first leave the value before it can pass it.
// Reaching the value exactly counts as passing.
#pragma once

#include <functional>
#include <vector>

#include "lib/ode/event.h"
#include "lib/simulation/checkpoint/archive.h"

namespace orthodyn {

class EventFinder {
 public:
  using Interpolate = std::function<void(double t, State& out)>;

  explicit EventFinder(std::vector<Event> events)
      : events_(std::move(events)), side_(events_.size(), 0), occurrences_(events_.size(), 0) {}

  bool empty() const { return events_.empty(); }

  // Initialises at the start of a run. Throws RunError if a quantity is not finite.
  void start(const ObservedState& observed);

  // The crossings in (begin, end], in order of time, up to the first that stops the run. `source`: the model whose
  // quantities are evaluated.
  std::vector<Crossing> find(double begin, double end, const OutputSource& source, const Interpolate& interpolate);

  // Names of events that have not occurred so far.
  std::vector<std::string> not_found() const;

  void save(Archive& archive) const;
  void restore(const Archive& archive);

 private:
  struct Sample {
    double t;
    std::vector<double> excess;  // quantity - value of each event
  };
  std::vector<Crossing> counted(std::vector<Crossing> found);
  Sample sample(double t, const OutputSource& source, const Interpolate& interpolate) const;

  std::vector<Event> events_;
  std::vector<int> side_;            // sign of quantity - value at the last sample
  std::vector<double> occurrences_;  // number of occurrences of each event
};

}  // namespace orthodyn
