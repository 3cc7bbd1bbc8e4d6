// The exact solution of a linear model under constant loads, by its modes: K phi = lambda M phi, and
// each coordinate q'' + d q' + lambda q = f in closed form.
#pragma once

#include <optional>

#include "lib/ode/model.h"

namespace orthodyn {

class ModalSolution {
 public:
  // Nothing if the model has no such solution: not linear, loads that vary in time, damping that couples
  // the modes, more than 2,000 unknowns (the eigenproblem is dense), or modes so much slower than the
  // fastest (1e4 times) that round-off hides their frequencies.
  static std::optional<ModalSolution> find(const Model& model, const State& initial);

  State at(double t) const;

  // What round-off may do to it up to a time, relative: the phase of the slowest mode, whose eigenvalue is
  // known to eps of the largest.
  double round_off(double t) const;

 private:
  ModalSolution() = default;

  double start_ = 0;
  Eigen::MatrixXd shapes_;                  // M-orthonormal
  Vector lambda_, damping_, load_, q_, v_;  // in modal coordinates; q and v at the start
};

}  // namespace orthodyn
