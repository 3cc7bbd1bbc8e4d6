#include "lib/simulation/observers/event_finder.h"

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

// The time in (a, b] at which the function, which changes its sign there, does so.
double root(const std::function<double(double)>& f, double a, double fa, double b, double fb) {
  if (fb == 0) return b;
  std::uintmax_t evaluations = 100;
  const double resolution = 4 * std::numeric_limits<double>::epsilon() * std::max({std::abs(a), std::abs(b), b - a});
  const auto close = [=](double x, double y) { return y - x <= resolution; };
  const auto [low, high] = boost::math::tools::toms748_solve(f, a, b, fa, fb, close, evaluations);
  return high;
}

}  // namespace

double EventFinder::excess(const Event& event, const State& state) const {
  const double value = event.quantity(state);
  if (!std::isfinite(value))
    throw RunError(fmt::format("event '{}' at t = {:.6g} s: the quantity is not finite", event.name, state.t));
  return value - event.value;
}

void EventFinder::start(const State& state) {
  for (std::size_t k = 0; k < events_.size(); ++k) {
    const double x = excess(events_[k], state);
    const double round_off = 64 * std::numeric_limits<double>::epsilon() * std::abs(events_[k].value);
    side_[k] = std::abs(x) <= round_off ? 0 : sign(x);
  }
}

std::vector<Crossing> EventFinder::find(double begin, double end, const Interpolate& interpolate) {
  std::vector<Crossing> found;
  for (std::size_t k = 0; k < events_.size(); ++k) find_in_step(k, begin, end, interpolate, found);
  std::stable_sort(found.begin(), found.end(),
                   [](const Crossing& a, const Crossing& b) { return a.state.t < b.state.t; });
  const auto stop = std::find_if(found.begin(), found.end(), [](const Crossing& c) { return c.event->stops; });
  if (stop != found.end()) found.erase(stop + 1, found.end());
  return found;
}

void EventFinder::find_in_step(std::size_t event, double begin, double end, const Interpolate& interpolate,
                          std::vector<Crossing>& found) {
  const Event& e = events_[event];
  State state;
  const auto excess_at = [&](double t) {
    interpolate(t, state);
    return excess(e, state);
  };
  double last_t = begin, last_x = side_[event] == 0 ? 0 : excess_at(begin);
  for (int sample = 1; sample <= kSamplesPerStep; ++sample) {
    const double t = sample == kSamplesPerStep ? end : begin + (end - begin) * sample / kSamplesPerStep;
    const double x = excess_at(t);
    const bool passed = side_[event] != 0 && sign(x) != side_[event];
    const bool upward = side_[event] < 0;
    if (passed && (e.direction == Direction::both || upward == (e.direction == Direction::up))) {
      // What round-off shows at the step's beginning was seen before.
      const double at = sign(last_x) == side_[event] ? root(excess_at, last_t, last_x, t, x) : last_t;
      interpolate(at, state);
      found.push_back({&e, state, upward});
    }
    side_[event] = sign(x);
    last_t = t;
    last_x = x;
  }
}

void EventFinder::save(Archive& archive) const {
  archive.put("sides", std::vector<double>(side_.begin(), side_.end()));
}

void EventFinder::restore(const Archive& archive) {
  const auto& sides = archive.numbers("sides", side_.size());
  std::transform(sides.begin(), sides.end(), side_.begin(), [](double side) { return sign(side); });
}

}  // namespace orthodyn
