#include "lib/simulation/run/turn_count.h"

namespace orthodyn {

TurnCount::TurnCount(const Model& model, const State& initial) : model_(model) {
  const Angles found = model.angles(initial);
  const bool known = initial.angles.size() == found.values.size();
  end_ = {initial.t, known ? nearest_turns(found.values, initial.angles) : found.values, found.rates};
  begin_ = end_;
}

void TurnCount::advance(const State& end) {
  if (empty()) return;
  begin_ = std::move(end_);
  const Angles found = model_.angles(end);
  const Vector expected = begin_.angles + (end.t - begin_.t) / 2 * (begin_.rates + found.rates);
  end_ = {end.t, nearest_turns(found.values, expected), found.rates};
}

Vector TurnCount::at(double t) const {
  if (end_.t == begin_.t) return end_.angles;
  return begin_.angles + (t - begin_.t) / (end_.t - begin_.t) * (end_.angles - begin_.angles);
}

}  // namespace orthodyn
