// Estimates the motion that a set of modes leaves out, relative to the whole motion, in the mass norm |x|^2 = x^T M x.
//
// The modes left out are replaced by their static response u = S (f - M Phi Phi^T f) (modal_basis.h). For one of them,
// with eigenvalue lambda and modal damping d, the error r of this response obeys
//
//   r'' + d r' + lambda r = -(u'' + d u').
//
// The error has two parts:
//
//   Free vibrations, caused by a start or by a jump of u or u' at a kink of the load. They start with the errors e_q of
//   the position and e_v of the velocity. Without damping their amplitude is sqrt(|e_q|^2 + (M e_v)^T S (M e_v)),
//   exactly. They decay like the lowest mode left out.
//
//   The lag of the response, |S (M u'' + D u')|: the next term of the expansion for slowly varying loads.
//
// The lag is not a bound if the load varies as fast as the modes left out (resonance). It is then at least as large as
// u itself.
#pragma once

#include "integrators/native/modal_load.h"

namespace orthodyn {

class ModalTruncation {
 public:
  // `basis` must outlive this object.
  explicit ModalTruncation(const ModalBasis& basis) : basis_(basis) {}

  // Records a start from a state with modal coordinates `begin`. `load`: load of the first step.
  void start(const State& from, const ModalState& begin, const StepLoad& load);

  // Records one step.
  void step(const ModalState& begin, const ModalState& end, const StepLoad& load);

  // Records the amplitudes with which the motion would continue from a state under the constant load at `theta`.
  void record_motion(const ModalState& state, const StepLoad& load, double theta);

  // Motion left out as a share of the largest displacement or velocity; 0 if nothing has moved.
  double displacement_share() const { return motion_ > 0 ? displacement_ / motion_ : 0; }
  double velocity_share() const { return speed_ > 0 ? velocity_ / speed_ : 0; }

 private:
  void add_free_vibration(const Vector& e_q, const Vector& e_v);
  void update_lag(double h, const Vector& u_rate, const Vector& u_acceleration);

  const ModalBasis& basis_;
  double free_displacement2_ = 0, free_velocity2_ = 0;  // current squared amplitudes
  double displacement_ = 0, velocity_ = 0;              // largest amplitudes left out so far
  double motion_ = 0, speed_ = 0;                       // largest amplitudes of the motion so far
};

}  // namespace orthodyn
