#include "lib/simulation/sensitivity/stiffness_product.h"

namespace orthodyn {

Vector stiffness_times(const Model& model, double t, const Vector& q, const Vector& x, double small) {
  const double largest = x.lpNorm<Eigen::Infinity>();
  if (largest == 0) return Vector::Zero(x.size());
  const double h = small / largest;
  const Vector still = Vector::Zero(x.size());
  Vector before(x.size()), after(x.size());
  model.force(t, q - h * x, still, before);
  model.force(t, q + h * x, still, after);
  return (before - after) / (2 * h);
}

}  // namespace orthodyn
