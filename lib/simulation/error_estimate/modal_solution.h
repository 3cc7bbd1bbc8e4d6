// Exact solution of a linear model under constant loads by modal superposition. The modes phi satisfy
// K phi = lambda M phi. Each mode's coordinate q satisfies q'' + d q' + lambda q = f with the modal damping d and load
// f, and is computed in closed form; a prime is a time derivative.
#pragma once

#include <optional>

#include "lib/ode/model.h"

namespace orthodyn {

class ModalSolution {
 public:
  // Empty if the model is nonlinear, or if it has time-dependent loads, an unsymmetric tangent, damping that couples
  // modes, or more than 2,000 unknowns (the eigenproblem is dense). Also empty if the frequency of an elastic mode is
  // at most 1e-4 of the highest frequency: round-off would make such a low frequency inaccurate.
  static std::optional<ModalSolution> find(const Model& model, const State& initial);

  State at(double t) const;

  // Relative error at time t due to round-off: the phase error of the slowest elastic mode, whose eigenvalue has an
  // error of eps times the largest eigenvalue.
  double round_off(double t) const;

 private:
  ModalSolution() = default;

  double start_ = 0;
  Eigen::MatrixXd shapes_;                  // M-orthonormal
  Vector lambda_, damping_, load_, q_, v_;  // in modal coordinates; q and v at the start
};

}  // namespace orthodyn
