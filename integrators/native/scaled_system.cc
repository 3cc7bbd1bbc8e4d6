#include "integrators/native/scaled_system.h"

#include <algorithm>
#include <cmath>

namespace orthodyn {

ScaledSystem::ScaledSystem(const Model& model, double rtol, const Scales& scales)
    : model_(model),
      q_unit_(rtol * scales.position),
      v_unit_(rtol * scales.velocity),
      t_unit_(q_unit_ / scales.velocity),
      n_(model.num_dofs()),
      size_(2 * n_ + (model.traits().time_dependent ? 1 : 0)),
      stiffness_(model.pattern().row.size()),
      damping_(model.pattern().row.size()),
      slope_(Vector::Zero(n_)),
      force_(n_),
      damping_force_(n_) {}

void ScaledSystem::rate(const Vector& v, const Vector& a, Vector& F) const {
  F.resize(size_);
  F.head(n_) = v / q_unit_;
  F.segment(n_, n_) = a / v_unit_;
  if (with_time()) F[2 * n_] = 1 / t_unit_;
}

void ScaledSystem::linearize(const State& at) {
  model_.linearize(at.t, at.q, at.v, TangentKind::exact, linearization_);
  model_.combine({0, 0, 1}, linearization_, stiffness_.data());
  model_.combine({0, 1, 0}, linearization_, damping_.data());
  damped_ = std::any_of(damping_.begin(), damping_.end(), [](double x) { return x != 0; });
}

void ScaledSystem::multiply(const Eigen::Ref<const Vector>& x, VectorRef y) {
  model_.pattern().multiply(stiffness_.data(), x.head(n_), force_);
  force_ *= -q_unit_ / v_unit_;
  if (damped_) {
    model_.pattern().multiply(damping_.data(), x.segment(n_, n_), damping_force_);
    force_ -= damping_force_;
  }
  model_.solve_mass(force_);
  y.head(n_) = v_unit_ / q_unit_ * x.segment(n_, n_);
  y.segment(n_, n_) = force_;
  if (!with_time()) return;
  y.segment(n_, n_) += t_unit_ / v_unit_ * x[2 * n_] * slope_;
  y[2 * n_] = 0;
}

void ScaledSystem::move(const Vector& z, Vector& q, Vector& v) const {
  q += q_unit_ * z.head(n_);
  v += v_unit_ * z.segment(n_, n_);
}

double ScaledSystem::rms(const Vector& z) const { return z.norm() / std::sqrt(static_cast<double>(size_)); }

std::size_t ScaledSystem::bytes() const {
  return (3 * static_cast<std::size_t>(n_) + 4 * stiffness_.size()) * sizeof(double);
}

}  // namespace orthodyn
