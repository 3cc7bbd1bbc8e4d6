#include "integrators/native/modal_truncation.h"

#include <algorithm>
#include <cmath>

namespace orthodyn {

void ModalTruncation::start(const State& from, const ModalState& begin, const StepLoad& load) {
  if (basis_.is_complete()) return;
  const Vector e_q = from.q - basis_.shapes() * begin.r - load.correction_at(0);
  Vector e_v = from.v - basis_.shapes() * begin.rate;
  if (load.varies) e_v -= load.correction_rate(0);
  add_free_vibration(e_q, e_v);
}

void ModalTruncation::step(const ModalState& begin, const ModalState& end, const StepLoad& load) {
  if (basis_.is_complete()) return;
  update_lag(load.h, load.correction_rate(0.5), load.correction_acceleration(0.5));
  record_motion(begin, load, 0);
  record_motion(end, load, 1);
}

void ModalTruncation::record_motion(const ModalState& state, const StepLoad& load, double theta) {
  const Vector middle = modal_equilibrium(basis_, load.modal_at(theta)), u = load.correction_at(theta);
  double displacement = u.dot(basis_.times_mass(u)), velocity = 0;
  for (Eigen::Index k = 0; k < basis_.size(); ++k) {
    const double lambda = basis_.lambda()[k], away = state.r[k] - middle[k], rate = state.rate[k];
    displacement += lambda > 0 ? middle[k] * middle[k] + away * away + rate * rate / lambda : state.r[k] * state.r[k];
    velocity += rate * rate + lambda * away * away;
  }
  motion_ = std::max(motion_, std::sqrt(displacement));
  speed_ = std::max(speed_, std::sqrt(velocity));
}

void ModalTruncation::add_free_vibration(const Vector& e_q, const Vector& e_v) {
  const Vector momentum = basis_.times_mass(e_v);
  const Vector stopped_by = basis_.static_correction(momentum);
  free_displacement2_ += e_q.dot(basis_.times_mass(e_q)) + std::max(stopped_by.dot(momentum), 0.0);
  free_velocity2_ += e_v.dot(momentum) + std::max(e_q.dot(basis_.times_stiffness(e_q)), 0.0);
  displacement_ = std::max(displacement_, std::sqrt(free_displacement2_));
  velocity_ = std::max(velocity_, std::sqrt(free_velocity2_));
}

void ModalTruncation::update_lag(double h, const Vector& u_rate, const Vector& u_acceleration) {
  const Vector behind = basis_.static_correction(basis_.times_mass(u_acceleration) + basis_.times_damping(u_rate));
  displacement_ = std::max(displacement_, std::sqrt(free_displacement2_ + behind.dot(basis_.times_mass(behind))));
  const double decay = std::exp(-basis_.next_damping() * h);
  free_displacement2_ *= decay;
  free_velocity2_ *= decay;
}

}  // namespace orthodyn
