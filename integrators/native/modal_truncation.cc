#include "integrators/native/modal_truncation.h"

#include <algorithm>
#include <cmath>

namespace orthodyn {

void ModalTruncation::start(const State& from, const ModalState& begin, const StepLoad& load) {
  if (basis_.is_complete()) return;
  const Vector e_q = from.q - basis_.shapes() * begin.r - load.rest_at(0);
  Vector e_v = from.v - basis_.shapes() * begin.rate;
  if (load.varies) e_v -= load.rest_rate(0);
  ring(e_q, e_v);
}

void ModalTruncation::step(const ModalState& begin, const ModalState& end, const StepLoad& load) {
  if (basis_.is_complete()) return;
  lag(load.h, load.rest_rate(0.5), load.rest_acceleration(0.5));
  reach(begin, load, 0);
  reach(end, load, 1);
}

// By the amplitudes.
void ModalTruncation::reach(const ModalState& state, const StepLoad& load, double theta) {
  const Vector middle = modal_equilibrium(basis_, load.modal_at(theta)), u = load.rest_at(theta);
  double displacement = u.dot(basis_.times_mass(u)), velocity = 0;
  for (Eigen::Index k = 0; k < basis_.size(); ++k) {
    const double lambda = basis_.lambda()[k], away = state.r[k] - middle[k], rate = state.rate[k];
    displacement += lambda > 0 ? middle[k] * middle[k] + away * away + rate * rate / lambda : state.r[k] * state.r[k];
    velocity += rate * rate + lambda * away * away;
  }
  motion_ = std::max(motion_, std::sqrt(displacement));
  speed_ = std::max(speed_, std::sqrt(velocity));
}

void ModalTruncation::ring(const Vector& e_q, const Vector& e_v) {
  const Vector momentum = basis_.times_mass(e_v);
  const Vector stopped_by = basis_.static_rest(momentum);
  ringing_ += e_q.dot(basis_.times_mass(e_q)) + std::max(stopped_by.dot(momentum), 0.0);
  ringing_speed_ += e_v.dot(momentum) + std::max(e_q.dot(basis_.times_stiffness(e_q)), 0.0);
  displacement_ = std::max(displacement_, std::sqrt(ringing_));
  velocity_ = std::max(velocity_, std::sqrt(ringing_speed_));
}

void ModalTruncation::lag(double h, const Vector& u_rate, const Vector& u_acceleration) {
  const Vector behind = basis_.static_rest(basis_.times_mass(u_acceleration) + basis_.times_damping(u_rate));
  displacement_ = std::max(displacement_, std::sqrt(ringing_ + behind.dot(basis_.times_mass(behind))));
  const double decay = std::exp(-basis_.next_damping() * h);
  ringing_ *= decay;
  ringing_speed_ *= decay;
}

}  // namespace orthodyn
