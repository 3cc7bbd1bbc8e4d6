#include "lib/ode/load_path.h"

#include <algorithm>

#include "lib/core/errors.h"

namespace orthodyn {

LoadPath::LoadPath(const Model& model, const PathTimes& times, Vector start)
    : model_(model), times_(times), start_(std::move(start)), load_(start_.size()) {
  bool is_finite = false;
  try {
    model.force(times.begin, start_, Vector::Zero(start_.size()), load_);
    const Vector first = rate(0, start_);
    largest_load_ = space().largest_entry(first);
    is_finite = space().is_finite(first);
  } catch (const RecoverableError& e) {
    throw RunError(std::string("the forces cannot be evaluated at the start: ") + e.what(), Reason::force);
  }
  if (!is_finite)
    throw RunError("the forces at the start are not finite; check the loads", Reason::force);
}

void LoadPath::force(double lambda, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const {
  model_.force(times_.at(lambda), q, v, f);
  f -= (1 - lambda) * load_;
}

Vector LoadPath::rate(double lambda, const ConstVectorRef& q) const {
  if (!moves_supports()) return load_;
  constexpr double kStep = 1e-5;  // of lambda: errors of 1e-10, by the square of the step and by round-off
  const Vector still = Vector::Zero(q.size());
  const auto force_at = [&](double factor) {
    Vector f(q.size());
    force(factor, q, still, f);
    return f;
  };
  const double at = std::clamp(lambda, 0.0, 1.0), inwards = at < kStep ? 1 : at > 1 - kStep ? -1 : 0;
  if (inwards == 0) return (force_at(at + kStep) - force_at(at - kStep)) / (2 * kStep);
  const double step = inwards * kStep;
  return (4 * force_at(at + step) - 3 * force_at(at) - force_at(at + 2 * step)) / (2 * step);
}

}  // namespace orthodyn
