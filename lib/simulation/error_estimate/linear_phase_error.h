// Phase error of vibrations computed with linear kinematics: with the exact force, the frequency is different, so that
// the exact motion drifts away from the computed one. The error e of the displacement (mass norm, sqrt(kg) m) satisfies
//
//   de/dt + gamma e = min(omega |s^T M x|, sqrt(|s^T M x| |s^T K x|)) / (2 |s|_M),   x = (d(m + s) - d(m - s)) / 2,
//
// where
//
//   m      mean displacement in a window of time, usually a few periods
//   s      largest deviation from m in the window, with |s|_M = sqrt(s^T M s)
//   d(q)   displacement from q to the shape in which the exact force equals the linear force at q (Linearity)
//   M, K   mass and stiffness matrix of the model; K x is computed as a difference of forces
//   gamma  decay rate of free vibrations, 1/s
//   omega  angular frequency of the motion, rad/s
//
// The vector x is the part of d that is odd in s; the even part cancels within a period. If the model as a whole is
// nonlinear, x = d(m + s) is used instead. For a single mode whose exact stiffness is lower by the fraction delta, the
// right-hand side is delta omega |s|_M / 2. For a cubic force with the fraction delta at the peak, the exact factor is
// 3/8 instead of 1/2. Source: first-order averaging (Nayfeh & Mook, Nonlinear Oscillations, 1979, 2.3).
#pragma once

#include "lib/analysis/linearity.h"
#include "lib/simulation/checkpoint/archive.h"

namespace orthodyn {

class PhaseError {
 public:
  // `model` must outlive the object. The motion starts at `start` (s).
  PhaseError(const FemModel& model, double start);

  // Adds a state to the window. Call with states in ascending time.
  void observe(const State& state);
  // True if the window of observed states spans at least one period, and at least a quarter of the time elapsed before
  // the window. Then call integrate_window() or discard_window().
  bool is_full() const;
  void integrate_window(Linearity& linearity);  // advances e; throws RunError if the stiffness cannot be factorised
  void discard_window();

  // The largest e so far, sqrt(kg) m. error() leaves out the present window, error_with_window() includes it.
  double error() const { return largest_error_; }
  double error_with_window(Linearity& linearity) const;

  void save(Archive& archive) const;
  void restore(const Archive& archive);

 private:
  struct Window {
    double duration = 0, swings = 0, velocities = 0;  // s; integrals of (q-mean)^T M (q-mean) and v^T M v
    double t = 0, square = 0;                         // of `farthest`: time (s), (q-mean)^T M (q-mean)
    Vector mean, farthest;
  };
  Window empty() const;
  double frequency() const;  // of the motion in this window, rad/s

  const FemModel& model_;
  double start_, time_;  // s
  Window window_;
  double error_ = 0, largest_error_ = 0;  // e at the start of the window, and the largest so far
};

}  // namespace orthodyn
