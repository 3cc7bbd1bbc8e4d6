// The largest stable step of the leapfrog scheme of central_differences.h.
//
// For the largest kappa of K x = kappa M x and delta of D x = delta M x it is the h of
//     h^2 kappa + 4 h delta = 4,   h = 2 / (delta + sqrt(delta^2 + kappa)),
// which is 2/omega where nothing is damped and 2/omega (sqrt(1 + 4 xi^2) - 2 xi) where kappa = omega^2 and
// delta = 2 xi omega belong to one mode, as with stiffness-proportional damping; else it is below the limit.
#pragma once

#include "integrators/spectral_bound.h"
#include "lib/ode/statistics.h"

namespace orthodyn {

class CriticalStep {
 public:
  // Both must outlive this.
  CriticalStep(const Model& model, Statistics& statistics);

  // About a state, s; infinite where nothing resists. Throws RecoverableError where the model does.
  double at(const State& state);

 private:
  double largest(const Weights& weights, SpectralBound& bound);

  const Model& model_;
  Statistics& statistics_;
  SpectralBound stiffness_, damping_;
  Linearization linearization_;
  std::vector<double> values_;
};

}  // namespace orthodyn
