#include "integrators/native/rattle.h"

#include <algorithm>

#include "lib/core/errors.h"

namespace orthodyn {

void Rattle::finish(StepEnd& end) {
  free_ = end.a;
  at_.emplace(model_, end.t, end.q);
  at_->fit(end.v);
  end.lambda = at_->multipliers(end.v, end.a);
}

// Newton's method with the derivative at the begin of the step, until changes are round-off and shrink no more.
Vector Rattle::change(double t, const ConstVectorRef& q) const {
  constexpr int kMost = 50;
  constexpr double kShrinking = 0.5, kRoundOff = 1e-10;  // ratio of changes; relative to the bodies
  const Constraints& constraints = *model_.constraints();
  Vector all = Vector::Zero(q.size()), g(constraints.size());
  const double round_off = kRoundOff * std::max(extent_, q.norm());
  double last = 0;
  for (int k = 0; k < kMost; ++k) {
    constraints.values(t, q + all, g);
    const Vector step = at_->least_change(g);
    const double size = step.norm();
    if (size == 0 || (k > 0 && last <= round_off && !(size < kShrinking * last))) return all;
    if (k > 1 && !(size < last)) break;
    all -= step;
    last = size;
  }
  throw RecoverableError("the step does not reach the constraints");
}

}  // namespace orthodyn
