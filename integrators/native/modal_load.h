// The load on the modes of a basis during a step, the motion of these modes, and the static correction for the modes
// left out. The load f(t, 0, 0) is interpolated at six Chebyshev points by polynomials of degree 5
// (chebyshev_interpolation.h). The interpolation error is measured at two more points.
#pragma once

#include "integrators/native/chebyshev_interpolation.h"
#include "integrators/native/modal_basis.h"
#include "integrators/scaled_norm.h"
#include "lib/ode/statistics.h"

namespace orthodyn {

// The load over one step, as a function of theta = (time - t) / h in [0, 1].
struct StepLoad {
  double t = 0, h = 0;         // start and length of the step, s; h = 0 before the first step
  bool varies = false;         // false for a load that is constant over the step
  Vector first;                // f at the first point, N
  Eigen::MatrixXd modal;       // coefficients of Phi^T f
  Eigen::MatrixXd correction;  // coefficients of u, the static correction; one column unless the load varies

  Vector modal_at(double theta) const { return polynomial_value(modal, theta); }
  Vector correction_at(double theta) const {
    return varies ? polynomial_value(correction, theta) : Vector(correction.col(0));
  }
  Vector correction_rate(double theta) const;
  Vector correction_acceleration(double theta) const;
};

class ModalLoad {
 public:
  // All arguments must outlive this object. Forces and solves are counted in `statistics`.
  ModalLoad(const Model& model, const ModalBasis& basis, Statistics& statistics)
      : model_(model), basis_(basis), statistics_(statistics) {}

  // at(): the load at time t as a constant. over(): the load from t to t + h. Both throw RecoverableError if the load
  // cannot be evaluated.
  StepLoad at(double t);
  StepLoad over(double t, double h);

  // Norm of a bound on the response to the interpolation error. A load error of size e, in resonance with a mode of
  // frequency omega, causes at most min(h e / omega, h^2 e / 2) in displacement and h e in velocity. Throws
  // RecoverableError if the response is not finite.
  double error(const StepLoad& load, const ScaledNorm& norm);

 private:
  Vector force(double t);
  Vector correction(const Vector& f, const Vector& modal);

  const Model& model_;
  const ModalBasis& basis_;
  Statistics& statistics_;
};

// Modal coordinates r and their rates dr/dt.
struct ModalState {
  Vector r, rate;
};

// The modal state that approximates a state best in the mass norm.
ModalState modal_state(const ModalBasis& basis, const State& state);

// The modal state at time tau (s) after the start of the step, where it was `begin`.
ModalState modal_state_after(const ModalBasis& basis, const ModalState& begin, const StepLoad& load, double tau);

// Modal coordinates at rest under the load `modal` = Phi^T f; zero for modes without stiffness.
Vector modal_equilibrium(const ModalBasis& basis, const Vector& modal);

}  // namespace orthodyn
