#include "lib/ode/load_path.h"

#include <algorithm>
#include <cmath>

#include "lib/core/errors.h"

namespace orthodyn {

LoadPath::LoadPath(const Model& model, const PathTimes& times, Vector start)
    : model_(model), times_(times), start_(std::move(start)), load_(start_.size()) {
  try {
    model.force(times.begin, start_, Vector::Zero(start_.size()), load_);
    largest_load_ = rate(0, start_).lpNorm<Eigen::Infinity>();
  } catch (const RecoverableError& e) {
    throw RunError(std::string("the forces cannot be evaluated at the start: ") + e.what(), Reason::force);
  }
  if (!std::isfinite(largest_load_))
    throw RunError("the forces at the start are not finite; check the loads", Reason::force);
}

void LoadPath::force(double lambda, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const {
  model_.force(times_.at(lambda), q, v, f);
  f -= (1 - lambda) * load_;
}

Vector LoadPath::rate(double lambda, const ConstVectorRef& q) const {
  if (times_.begin == times_.end) return load_;
  constexpr double kStep = 1e-5;  // of lambda: errors of 1e-10, by the square of the step and by round-off
  const Vector still = Vector::Zero(q.size());
  const double low = std::max(lambda - kStep, 0.0), high = std::min(lambda + kStep, 1.0);
  Vector before(q.size()), after(q.size());
  force(low, q, still, before);
  force(high, q, still, after);
  return (after - before) / (high - low);
}

}  // namespace orthodyn
