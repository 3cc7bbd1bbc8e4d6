#include "integrators/native/linearly_implicit.h"

#include <utility>

namespace orthodyn {

LinearlyImplicit::LinearlyImplicit(const std::string& name, const Model& model, const LinearOptions& options,
                                   const Scales& scales, int tangent_steps)
    : OneStep(name, model, options, scales),
      solve_(model, options.linear_solver, options.tangent(), statistics_),
      tangent_steps_(tangent_steps),
      f_now_(model.num_dofs()),
      f_next_(model.num_dofs()) {}

void LinearlyImplicit::restarted() {
  model_.multiply_mass(now().a, f_now_);
  age_ = tangent_steps_;
  attempted_ = false;
}

bool LinearlyImplicit::prepare(double gamma) {
  const bool old = age_ >= tangent_steps_ || (attempted_ && age_ > 0);
  attempted_ = true;
  if (!linearized_ || (old && !model_.traits().linear)) {
    solve_.linearize(now().t, now().q, now().v);
    linearized_ = true;
    age_ = 0;
    gamma_ = 0;
  }
  if (gamma == gamma_) return true;
  gamma_ = solve_.factor(gamma) ? gamma : 0;
  return gamma_ != 0;
}

void LinearlyImplicit::finish(const ConstVectorRef& a) {
  force(next_.t, next_.q, next_.v, f_next_);
  next_.a = a;
}

void LinearlyImplicit::accepted(double) {
  std::swap(f_now_, f_next_);
  ++age_;
  attempted_ = false;
}

std::size_t LinearlyImplicit::method_bytes() const {
  return solve_.bytes() + 2 * static_cast<std::size_t>(model_.num_dofs()) * sizeof(double);
}

}  // namespace orthodyn
