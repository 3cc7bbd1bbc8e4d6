// What a motion by some of the modes leaves out, as a share of it, in the mass norm of displacements.
//
// The modes left out are taken to follow their load statically, u. What that misses of one of them obeys
// r'' + d r' + lambda r = -(u'' + d u'), and begins with what the state of the start differs from u:
//
//   vibrations that a start, or a jump of u or u' at a kink of the load, sets off: their amplitude is
//     (|e_q|^2 + (M e_v)' S (M e_v))^(1/2), exactly, undamped; they decay as the lowest mode left out does;
//   the lag of the response: |S (M u'' + D u')|, the next term of the expansion for loads that vary slowly.
//
// A load that varies as fast as the modes left out, up to resonance with one of them, is beyond the second: it then is
// as large as u itself or larger, and no bound.
#pragma once

#include "integrators/native/modal_motion.h"

namespace orthodyn {

class ModalTruncation {
 public:
  // `basis` must outlive this.
  explicit ModalTruncation(const ModalBasis& basis) : basis_(basis) {}

  // A start from a state, of which the modes take up `begin`, under the load of the first step.
  void start(const State& from, const ModalState& begin, const StepLoad& load);

  // A step.
  void step(const ModalState& begin, const ModalState& end, const StepLoad& load);

  // The motion that goes on from a state under the load at `theta` of the step.
  void reach(const ModalState& state, const StepLoad& load, double theta);

  // Of the largest displacement and the largest velocity; 0 where nothing has moved.
  double displacement_share() const { return motion_ > 0 ? displacement_ / motion_ : 0; }
  double velocity_share() const { return speed_ > 0 ? velocity_ / speed_ : 0; }

 private:
  void ring(const Vector& e_q, const Vector& e_v);
  void lag(double h, const Vector& u_rate, const Vector& u_acceleration);

  const ModalBasis& basis_;
  double ringing_ = 0, ringing_speed_ = 0;  // present amplitudes, squared
  double displacement_ = 0, velocity_ = 0;  // the largest amplitudes so far
  double motion_ = 0, speed_ = 0;
};

}  // namespace orthodyn
