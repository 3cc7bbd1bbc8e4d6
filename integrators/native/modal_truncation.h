// Estimates the motion that a set of modes leaves out, relative to the whole motion, in the mass norm |x|^2 = x^T M x.
//
// The modes left out are replaced by their static response u = S (f - M Phi Phi^T f) (modal_basis.h). For one of them,
// with eigenvalue lambda and modal damping d, the error r of this response obeys
//
//   r'' + d r' + lambda r = -(u'' + d u').
//
// The error has two parts:
//
//   Free vibrations, caused by the start or by a jump of u or u' at a kink of the load. They begin with the errors e_q
//   of the position and e_v of the velocity. Without damping their amplitude is exactly
//   sqrt(|e_q|^2 + (M e_v)^T S (M e_v)). They are assumed to decay like the lowest mode left out.
//
//   The lag of the response, |S (M u'' + D u')|: the leading term of the error if the load varies slowly. It is counted
//   in displacements only.
//
// The lag is not a bound on the error if the load varies as fast as a mode left out (resonance); in that mode the lag
// is then at least |u|.
#pragma once

#include "integrators/native/modal_load.h"

namespace orthodyn {

class ModalTruncation {
 public:
  // `basis` must outlive this object.
  explicit ModalTruncation(const ModalBasis& basis) : basis_(basis) {}

  // Records a start, or a restart at a kink. `begin`: modal coordinates of `from`. `load`: load of the next step.
  void start(const State& from, const ModalState& begin, const StepLoad& load);

  // Records one step.
  void step(const ModalState& begin, const ModalState& end, const StepLoad& load);

  // Records the amplitudes of the whole motion after `state` under a constant load: the load at the fraction `theta` of
  // the step.
  void record_motion(const ModalState& state, const StepLoad& load, double theta);

  // Largest amplitude left out / largest amplitude of the motion; 0 if nothing has moved.
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
