// The largest stable step of the leapfrog scheme of central_differences.cc.
//
// With the largest eigenvalues kappa (1/s^2) of K x = kappa M x and delta (1/s) of D x = delta M x, the step h is the
// solution of h^2 kappa + 4 h delta = 4,
//
//     h = 2 / (delta + sqrt(delta^2 + kappa)).
//
// Let kappa = omega^2. Without damping, h = 2/omega. If delta = 2 xi omega belongs to the same mode as omega, as with
// stiffness-proportional damping, h is the exact limit 2/omega (sqrt(1 + 4 xi^2) - 2 xi). Otherwise h is below the
// limit.
//
// Contact may begin between two evaluations of the stiffness. kappa therefore includes upper bounds for the stiffness
// of contact and all other force terms except elasticity. This sum bounds the largest eigenvalue at every depth of
// contact, because the largest eigenvalue of a sum of matrices is at most the sum of their largest eigenvalues (Weyl).
#pragma once

#include <string>

#include "integrators/spectral_bound.h"
#include "lib/ode/integrator.h"
#include "lib/ode/statistics.h"

namespace orthodyn {

class CriticalStep {
 public:
  // Both arguments must outlive this object.
  CriticalStep(const Model& model, Statistics& statistics);

  // Critical step (s) at a state; infinite without stiffness and damping. Throws the model's RecoverableError. Not
  // thread-safe, because it keeps start vectors for the next call.
  double at(const State& state) { return limit(state, contact_bound_); }
  // As at(), but without reserve().
  double at_present(const State& state) { return limit(state, 0); }

  // Upper bound (1/s^2) of the increase of kappa by later contact; 0 if contact cannot add stiffness.
  double reserve() const { return contact_bound_; }

  // delta / kappa (s) at the state of the last call, with kappa excluding reserve(). It equals beta if D = beta K, and
  // is 0 without damping or stiffness.
  double damping_time() const { return damping_time_; }

 private:
  double limit(const State& state, double reserve);
  double largest(const Linearization& at, const Weights& weights, SpectralBound& bound);

  const Model& model_;
  Statistics& statistics_;
  double contact_bound_, damping_time_ = 0;
  SpectralBound stiffness_, damping_;
};

// Throws ConfigError if an explicit adaptive method cannot reach the end of the run within max_steps; the message gives
// the smallest possible number of steps. Steps of the method are at most `reach` times the leapfrog's critical step.
void refuse_too_many_steps(const std::string& name, const Model& model, const Task& task, double reach, long max_steps);

}  // namespace orthodyn
