// The load on the modes of a basis, and the static response of those left out, over a step: f(t, 0, 0) at Chebyshev's
// six points, interpolated by polynomials of degree 5 (load_polynomial.h), whose error is told at two more points.
#pragma once

#include "integrators/native/load_polynomial.h"
#include "integrators/native/modal_basis.h"
#include "integrators/scaled_norm.h"
#include "lib/ode/statistics.h"

namespace orthodyn {

// By shares theta of the step, in [0, 1].
struct StepLoad {
  double t = 0, h = 0;  // s; h = 0: none
  bool varies = false;
  Vector first;           // f at the first point
  Eigen::MatrixXd modal;  // phi' f, by coefficients
  Eigen::MatrixXd rest;   // the response u of the modes left out, likewise; a single column unless the load varies

  Vector modal_at(double theta) const { return load_value(modal, theta); }
  Vector rest_at(double theta) const { return varies ? load_value(rest, theta) : Vector(rest.col(0)); }
  Vector rest_rate(double theta) const;
  Vector rest_acceleration(double theta) const;
};

class ModalLoad {
 public:
  // All must outlive it. Forces and solutions are counted in `statistics`.
  ModalLoad(const Model& model, const ModalBasis& basis, Statistics& statistics)
      : model_(model), basis_(basis), statistics_(statistics) {}

  // What the load is at a time, as if it were constant. Both throw RecoverableError if it cannot be evaluated.
  StepLoad at(double t);
  StepLoad over(double t, double h);

  // What the interpolated load is off, as if it were so throughout the step, in units of the norm; resonant modes
  // respond most. Throws RecoverableError if it is not finite.
  double error(const StepLoad& load, const ScaledNorm& norm);

 private:
  Vector force(double t);
  Vector rest(const Vector& f, const Vector& modal);

  const Model& model_;
  const ModalBasis& basis_;
  Statistics& statistics_;
};

}  // namespace orthodyn
