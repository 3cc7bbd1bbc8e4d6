// When conjugate gradients have come near enough to the solution: by the error itself, not by the residual, which a
// preconditioner that is not perfect makes small while the error is large (bending of slender bodies).
//
// With x_0 = 0 each iterate has the energy x_k . A x_k = b . x_k, and what is missing to that of the solution is the
// error's, |x - x_k|_A^2 (Hestenes & Stiefel 1952; Strakos & Tichy 2002). The gains of the last iterations, taken to go
// on falling as they did, tell it.
#pragma once

#include <array>

#include "lib/linear/solver.h"
#include "lib/petsc/session.h"

namespace orthodyn::petsc {

class EnergyTest {
 public:
  // Makes `method` stop by this test, where it is the method of conjugate gradients. This must outlive it.
  void attach(KSP method);

  // Of the next solutions, for the unknowns' number.
  void set(const SolveTolerance& tolerance, double unknowns);

 private:
  KSPConvergedReason test(KSP method, PetscInt iteration, double residual);
  double missing_energy() const;

  SolveTolerance tolerance_;
  double absolute_ = 0;  // of the sum's norm
  double first_residual_ = 0, energy_ = 0;
  std::array<double, 4> gains_{};  // of energy, the latest first
};

}  // namespace orthodyn::petsc
