#include "integrators/native/step_force.h"

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

const DiscreteGradient& gradient_of(const Model& model) {
  const DiscreteGradient* gradient = model.discrete_gradient();
  if (!gradient)
    throw ConfigError("energy_momentum needs a force that is the gradient of an energy, which the warped one is not; "
                      "set elasticity.corotation: exact, or choose another integrator");
  return *gradient;
}

}  // namespace

StepForce::StepForce(const Model& model)
    : model_(model), gradient_(gradient_of(model)), zero_(Vector::Zero(model.num_dofs())) {}

void StepForce::begin(double t0, const ConstVectorRef& q0, double h) {
  t0_ = t0;
  q0_ = q0;
  h_ = h;
}

void StepForce::force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const {
  gradient_.mean_force(t0_, q0_, t0_ + h_, 2 * q - q0_, f);
  if (!model_.traits().dissipative) return;
  Vector moving(q.size()), still(q.size());
  model_.force(t, q, v, moving);
  model_.force(t, q, zero_, still);
  f += moving - still;
}

}  // namespace orthodyn
