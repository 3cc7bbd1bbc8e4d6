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

#include "integrators/native/modal_basis.h"

namespace orthodyn {

class ModalTruncation {
 public:
  // `basis` must outlive this.
  explicit ModalTruncation(const ModalBasis& basis) : basis_(basis) {}

  // A start from a state that differs by these from what is represented.
  void start(const Vector& e_q, const Vector& e_v);

  // A step of length h: derivatives of u in it.
  void step(double h, const Vector& u_rate, const Vector& u_acceleration);

  // The motion has reached this, in the mass norm.
  void reach(double displacement, double velocity);

  // Of the largest displacement and the largest velocity; 0 where nothing has moved.
  double displacement_share() const { return motion_ > 0 ? displacement_ / motion_ : 0; }
  double velocity_share() const { return speed_ > 0 ? velocity_ / speed_ : 0; }

 private:
  const ModalBasis& basis_;
  double ringing_ = 0, ringing_speed_ = 0;  // present amplitudes, squared
  double displacement_ = 0, velocity_ = 0;  // the largest amplitudes so far
  double motion_ = 0, speed_ = 0;
};

}  // namespace orthodyn
