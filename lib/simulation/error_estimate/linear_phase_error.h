// What linear kinematics add up in a vibration, beside their error at the largest displacement: the exact force shifts
// its frequency, and the motions part. About the mean m of a few periods, with s the largest swing from it,
//
//   e' + gamma e = min(omega |s . M x|, (|s . M x| |s . K x|)^(1/2)) / (2 |s|_M),   x = (x(m + s) - x(m - s)) / 2,
//
// where x(q) is the displacement from q to the equilibrium of the exact force (Linearity), gamma the decay of free
// vibrations and omega the frequency of the motion. Of one mode, softer by delta, that is delta omega |s| / 2: a cubic
// force has 3/8 of the delta at its peak in place of 1/2. What is even in the swing cancels within a period. The
// largest e is kept; a report of it ends at twice the largest displacement.
// Source: first-order averaging (Nayfeh & Mook, Nonlinear Oscillations, 1979, 2.3).
#pragma once

#include "lib/analysis/linearity.h"
#include "lib/simulation/checkpoint/archive.h"

namespace orthodyn {

class PhaseError {
 public:
  // `model` must outlive it. The motion begins at `start`, s.
  PhaseError(const FemModel& model, double start);

  // In the order of time.
  void look_at(const State& state);
  // Whether what has been looked at is a period at least and a good part of the time since the start; it is then to be
  // taken in, or skipped.
  bool is_full() const;
  void take_in(Linearity& linearity);  // throws RunError where the stiffness cannot be factorised
  void skip();

  // The largest so far, in the mass norm; with what has been looked at since it was taken in last.
  double error() const { return largest_error_; }
  double error_now(Linearity& linearity) const;

  void save(Archive& archive) const;
  void restore(const Archive& archive);

 private:
  struct Window {
    double duration = 0, swings = 0, velocities = 0;  // s; integrals of (q - mean) . M (q - mean) and v . M v
    double t = 0, square = 0;  // s, of the farthest state from the mean so far, and how far that was
    Vector mean, farthest;
  };
  Window empty() const;
  double product(const Vector& x) const;  // x . M x
  double frequency() const;               // rad/s, of the motion in this window

  const FemModel& model_;
  double start_, time_;  // s
  Window window_;
  double error_ = 0, largest_error_ = 0;  // now, and the largest so far
};

}  // namespace orthodyn
