// Finds when quantities pass values within the steps of any integrator, on its dense output.
//
// Each step is sampled at its end and three times within; where the sign of quantity - value has changed
// between two samples, the root between them is found to round-off (algorithm 748, Alefeld, Potra & Shi 1995).
// Crossings there and back between two samples are missed. A quantity that has the value at the start has not passed
// it until it was elsewhere; one that reaches the value exactly has.
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
      : events_(std::move(events)), side_(events_.size(), 0), happened_(events_.size(), 0) {}

  bool empty() const { return events_.empty(); }

  // At the start, or anew. Throws RunError if a quantity is not finite.
  void start(const ObservedState& observed);

  // Those in (begin, end], in the order of time; none after the first that stops the run. `source` is what the
  // quantities are of.
  std::vector<Crossing> find(double begin, double end, const OutputSource& source, const Interpolate& interpolate);

  // The names of those that were never found so far.
  std::vector<std::string> silent() const;

  void save(Archive& archive) const;
  void restore(const Archive& archive);

 private:
  struct Sample {
    double t;
    std::vector<double> excess;  // of each event's quantity over its value
  };
  std::vector<Crossing> noted(std::vector<Crossing> found);
  Sample sample(double t, const OutputSource& source, const Interpolate& interpolate) const;

  std::vector<Event> events_;
  std::vector<int> side_;         // of its value, where each quantity was last seen
  std::vector<double> happened_;  // how often each
};

}  // namespace orthodyn
