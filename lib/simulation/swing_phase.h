// The phase that a vibration gains or loses by linear kinematics, by first-order averaging (Nayfeh & Mook 1979, Nonlinear
// Oscillations, 2.3): with q = mean + u, of natural frequency omega, the exact force shifts that by the share
//   (u . M x)/(2 u . M u),  x the displacement by what it adds (Linearity::softening()),
// averaged over the motion. A single mode with a cubic stiffness k (q + c q^3) gives 3 c A^2/8, as it should; what is
// quadratic counts by the mean alone. Looked at in some twenty windows of the run, a state in each.
#pragma once

#include <vector>

#include "lib/analysis/linearity.h"
#include "lib/simulation/observers/archive.h"

namespace orthodyn {

class SwingPhase {
 public:
  // `model` must outlive it. The motion begins at `start` and takes about `span`, s.
  SwingPhase(const FemModel& model, double start, double span);

  // In the order of time, each step's end and perhaps more.
  void look_at(const State& state);
  // Takes in what has been looked at since: some forces and a solution for each window. Throws RunError.
  void evaluate(Linearity& linearity);
  void finish(Linearity& linearity);  // with the window that is not full

  // The largest so far, in the mass norm, by which the phase puts the displacement off: the phase times the amplitude
  // at that time.
  double error() const { return error_; }

  // After evaluate().
  void save(Archive& archive) const;
  void restore(const Archive& archive);

 private:
  struct Window {
    double duration = 0, displacements = 0, velocities = 0;  // s; integrals of u . M u and v . M v
    double t = 0;                                            // s, of the state that is looked at; then of what it swings
    Vector mean = {}, swing = {};
  };
  void begin_window();
  double product(const Vector& x) const;  // x . M x

  const FemModel& model_;
  double start_, width_, time_;  // s; of a window; of the last state
  Vector mean_;                  // of the displacement so far
  double window_end_ = 0, look_ = 0;
  std::size_t windows_ = 0;
  Window window_;
  std::vector<Window> full_;
  double phase_ = 0, error_ = 0;  // rad; mass norm
};

}  // namespace orthodyn
