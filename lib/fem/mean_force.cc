#include "lib/fem/mean_force.h"

namespace orthodyn {

void MeanForce::mean_force(double t0, const ConstVectorRef& q0, double t1, const ConstVectorRef& q1,
                           VectorRef f) const {
  const Vector still = Vector::Zero(q0.size());
  const NodalExpansion begin(parts_, t0, q0, still), end(parts_, t1, q1, still);
  NodalVector sum = NodalVector::Zero(3, begin.x.cols());
  for (const auto& term : parts_.elastic) term->add_mean_force(begin.state(), end.state(), sum);
  for (const auto& term : parts_.loads) term->add_mean_force(begin.state(), end.state(), sum);
  parts_.dofs->restrict_to(sum, f);
}

}  // namespace orthodyn
