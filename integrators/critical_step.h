// The largest stable step of the leapfrog scheme of central_differences.cc.
//
// For the largest kappa of K x = kappa M x and delta of D x = delta M x it is the h of
//     h^2 kappa + 4 h delta = 4,   h = 2 / (delta + sqrt(delta^2 + kappa)),
// which is 2/omega where nothing is damped and 2/omega (sqrt(1 + 4 xi^2) - 2 xi) where kappa = omega^2 and
// delta = 2 xi omega belong to one mode, as with stiffness-proportional damping; else it is below the limit.
//
// Contact may set in between two evaluations of the stiffness. kappa therefore is that of the state plus what the
// forces that bound their own stiffness can come to: a bound at every depth of contact, for eigenvalues of a sum are at
// most the sum of the largest ones (Weyl).
#pragma once

#include <string>

#include "integrators/spectral_bound.h"
#include "lib/ode/integrator.h"
#include "lib/ode/statistics.h"

namespace orthodyn {

class CriticalStep {
 public:
  // Both must outlive this.
  CriticalStep(const Model& model, Statistics& statistics);

  // At a state, s; infinite where there is neither stiffness nor damping. Throws RecoverableError where the model does.
  // Keeps what the next call begins with: not thread-safe.
  double at(const State& state) { return limit(state, reserve_); }
  // The same without the stiffness that may set in later.
  double at_present(const State& state) { return limit(state, 0); }

  // The largest eigenvalue of stiffness that may set in later, 1/s^2; 0 where none can.
  double reserve() const { return reserve_; }

  // delta / kappa at the state of the last call, s: beta of damping beta K. 0 where nothing is damped or resists.
  double damping_time() const { return damping_time_; }

 private:
  double limit(const State& state, double reserve);
  double largest(const Linearization& at, const Weights& weights, SpectralBound& bound);

  const Model& model_;
  Statistics& statistics_;
  double reserve_, damping_time_ = 0;
  SpectralBound stiffness_, damping_;
};

// Refuses a run that an explicit method of variable step would not end within max_steps, each of them at most
// `reach` times the leapfrog's critical step long. Throws ConfigError with the least number of steps.
void refuse_a_run_without_end(const std::string& name, const Model& model, const Task& task, double reach,
                              long max_steps);

}  // namespace orthodyn
