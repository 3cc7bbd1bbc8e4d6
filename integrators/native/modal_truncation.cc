#include "integrators/native/modal_truncation.h"

#include <algorithm>
#include <cmath>

namespace orthodyn {

void ModalTruncation::start(const Vector& e_q, const Vector& e_v) {
  if (basis_.is_complete()) return;
  const Vector momentum = basis_.times_mass(e_v);
  const Vector stopped_by = basis_.static_rest(momentum);
  ringing_ += e_q.dot(basis_.times_mass(e_q)) + std::max(stopped_by.dot(momentum), 0.0);
  ringing_speed_ += e_v.dot(momentum) + std::max(e_q.dot(basis_.times_stiffness(e_q)), 0.0);
  displacement_ = std::max(displacement_, std::sqrt(ringing_));
  velocity_ = std::max(velocity_, std::sqrt(ringing_speed_));
}

void ModalTruncation::step(double h, const Vector& u_rate, const Vector& u_acceleration) {
  if (basis_.is_complete()) return;
  const Vector lag =
      basis_.static_rest(basis_.times_mass(u_acceleration) + basis_.times_damping(u_rate));
  displacement_ = std::max(displacement_, std::sqrt(ringing_ + lag.dot(basis_.times_mass(lag))));
  const double decay = std::exp(-basis_.next_damping() * h);
  ringing_ *= decay;
  ringing_speed_ *= decay;
}

void ModalTruncation::reach(double displacement, double velocity) {
  motion_ = std::max(motion_, displacement);
  speed_ = std::max(speed_, velocity);
}

}  // namespace orthodyn
