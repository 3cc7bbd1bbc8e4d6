// Convergence test of conjugate gradients by an estimate of the error in the energy norm. The preconditioned residual
// can be small while the error is large, as in bending of slender bodies.
//
// With x_0 = 0 the iterates have the energy x_k . A x_k = b . x_k. It differs from the energy of the solution x by the
// squared error |x - x_k|_A^2 (Hestenes & Stiefel 1952; Strakos & Tichy 2002). This difference is extrapolated from the
// energy gains of the last iterations.
#pragma once

#include <array>

#include "lib/linear/solver.h"
#include "lib/petsc/session.h"

namespace orthodyn::petsc {

class EnergyTest {
 public:
  // Makes `method` use this test if it is conjugate gradients. This object must outlive `method`.
  void attach(KSP method);

  // Sets the tolerance of the next solutions. `unknowns`: number of unknowns of all ranks.
  void set(const SolveTolerance& tolerance, double unknowns);

 private:
  KSPConvergedReason test(KSP method, PetscInt iteration, double residual);
  double missing_energy() const;

  SolveTolerance tolerance_;
  double absolute_ = 0;  // absolute tolerance of the 2-norm of x
  double first_residual_ = 0, energy_ = 0;
  std::array<double, 4> gains_{};  // energy gains, latest first
};

}  // namespace orthodyn::petsc
