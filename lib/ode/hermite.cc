#include "lib/ode/hermite.h"

namespace orthodyn {

void interpolate(const StepEnd& begin, const StepEnd& end, double t, VectorRef q, VectorRef v) {
  if (t == begin.t || t == end.t) {
    const StepEnd& at = t == end.t ? end : begin;
    q = at.q;
    v = at.v;
    return;
  }
  const double h = end.t - begin.t, s = (t - begin.t) / h, s2 = s * s, s3 = s2 * s, s4 = s3 * s, s5 = s4 * s;
  const auto change = end.q - begin.q;
  q = begin.q + (10 * s3 - 15 * s4 + 6 * s5) * change +
      h * ((s - 6 * s3 + 8 * s4 - 3 * s5) * begin.v + (-4 * s3 + 7 * s4 - 3 * s5) * end.v) +
      0.5 * h * h * ((s2 - 3 * s3 + 3 * s4 - s5) * begin.a + (s3 - 2 * s4 + s5) * end.a);
  v = (30 * s2 - 60 * s3 + 30 * s4) / h * change + (1 - 18 * s2 + 32 * s3 - 15 * s4) * begin.v +
      (-12 * s2 + 28 * s3 - 15 * s4) * end.v +
      0.5 * h * ((2 * s - 9 * s2 + 12 * s3 - 5 * s4) * begin.a + (3 * s2 - 8 * s3 + 5 * s4) * end.a);
}

void interpolate_linearly(const StepEnd& begin, const StepEnd& end, double t, VectorRef q, VectorRef v) {
  const double s = (t - begin.t) / (end.t - begin.t);
  q = (1 - s) * begin.q + s * end.q;
  v = (1 - s) * begin.v + s * end.v;
}

State mean_state(const StepEnd& begin, const StepEnd& end) {
  State mean{0.5 * (begin.t + end.t), 0.5 * (begin.q + end.q), (end.q - begin.q) / (end.t - begin.t)};
  if (begin.lambda.size() == end.lambda.size()) mean.lambda = 0.5 * (begin.lambda + end.lambda);
  return mean;
}

}  // namespace orthodyn
