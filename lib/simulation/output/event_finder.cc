#include "lib/simulation/output/event_finder.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

constexpr int kSamplesPerStep = 4;

int sign(double x) { return (x > 0) - (x < 0); }

// The root in (a, b] of a function that changes sign there.
double root(const std::function<double(double)>& f, double a, double fa, double b, double fb) {
  if (fb == 0) return b;
  std::uintmax_t evaluations = 100;
  const double resolution = 4 * std::numeric_limits<double>::epsilon() * std::max({std::abs(a), std::abs(b), b - a});
  const auto close = [=](double x, double y) { return y - x <= resolution; };
  const auto [low, high] = boost::math::tools::toms748_solve(f, a, b, fa, fb, close, evaluations);
  return high;
}

double excess(const Event& event, const ObservedState& observed) {
  const double value = event.quantity(observed);
  if (!std::isfinite(value))
    throw RunError(fmt::format("event '{}' at t = {:.6g} s: the quantity is not finite", event.name, observed.t()));
  return value - event.value;
}

}  // namespace

void EventFinder::start(const ObservedState& observed) {
  for (std::size_t k = 0; k < events_.size(); ++k) {
    const double x = excess(events_[k], observed);
    const double round_off = 64 * std::numeric_limits<double>::epsilon() * std::abs(events_[k].value);
    side_[k] = std::abs(x) <= round_off ? 0 : sign(x);
  }
}

EventFinder::Sample EventFinder::sample(double t, const OutputSource& source, const Interpolate& interpolate) const {
  State state;
  interpolate(t, state);
  const ObservedState observed(source, state);
  Sample sample{t, {}};
  for (const Event& event : events_) sample.excess.push_back(excess(event, observed));
  return sample;
}

std::vector<Crossing> EventFinder::find(double begin, double end, const OutputSource& source,
                                        const Interpolate& interpolate) {
  std::vector<Crossing> found;
  State state;
  Sample last = sample(begin, source, interpolate);
  for (int s = 1; s <= kSamplesPerStep; ++s) {
    const double t = s == kSamplesPerStep ? end : begin + (end - begin) * s / kSamplesPerStep;
    Sample now = sample(t, source, interpolate);
    for (std::size_t k = 0; k < events_.size(); ++k) {
      const Event& event = events_[k];
      const auto excess_at = [&](double time) {
        interpolate(time, state);
        return excess(event, {source, state});
      };
      const bool passed = side_[k] != 0 && sign(now.excess[k]) != side_[k];
      const bool upward = side_[k] < 0;
      if (passed && (event.direction == Direction::both || upward == (event.direction == Direction::up))) {
        // If the sign has already changed at last.t, the crossing is at last.t.
        const double at =
            sign(last.excess[k]) == side_[k] ? root(excess_at, last.t, last.excess[k], t, now.excess[k]) : last.t;
        interpolate(at, state);
        found.push_back({&event, state, upward});
      }
      side_[k] = sign(now.excess[k]);
    }
    last = std::move(now);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Crossing& a, const Crossing& b) { return a.state.t < b.state.t; });
  const auto stop = std::find_if(found.begin(), found.end(), [](const Crossing& c) { return c.event->stops; });
  if (stop == found.end()) return counted(std::move(found));
  found.erase(stop + 1, found.end());
  // Resets the signs to the time of the stop, because a resumed run repeats the rest of this step.
  const Sample there = sample(found.back().state.t, source, interpolate);
  for (std::size_t k = 0; k < events_.size(); ++k)
    side_[k] = &events_[k] != found.back().event ? sign(there.excess[k]) : found.back().upward ? 1 : -1;
  return counted(std::move(found));
}

std::vector<Crossing> EventFinder::counted(std::vector<Crossing> found) {
  for (const Crossing& c : found) ++occurrences_[static_cast<std::size_t>(c.event - events_.data())];
  return found;
}

std::vector<std::string> EventFinder::not_found() const {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < events_.size(); ++k)
    if (occurrences_[k] == 0) names.push_back(events_[k].name);
  return names;
}

void EventFinder::save(Archive& archive) const {
  archive.put("sides", std::vector<double>(side_.begin(), side_.end()));
  archive.put("happened", occurrences_);
}

void EventFinder::restore(const Archive& archive) {
  const auto& sides = archive.numbers("sides", side_.size());
  std::transform(sides.begin(), sides.end(), side_.begin(), [](double side) { return sign(side); });
  occurrences_ = archive.numbers("happened", events_.size());
}

}  // namespace orthodyn
