// The adjoint equations (lib/ode/adjoint_equations.h) as a backward problem of CVODES, attached to the memory of the
// motion.
//
// The vector of the library is (a, b). With g = -gamma > 0, since the library steps backward, its systems
// (I - gamma J) x = r reduce to
//
//     (M + g D + g^2 K) x_b = M r_b + g r_a,   x_a = r_a - g K x_b.
#pragma once

#include <memory>

#include "integrators/newton_matrix.h"
#include "integrators/sundials/callbacks.h"
#include "integrators/sundials/solver_adapter.h"
#include "integrators/sundials/sundials_options.h"
#include "lib/ode/adjoint_equations.h"

namespace orthodyn::sundials {

class BackwardProblem {
 public:
  // `memory`: of CVODES, after a forward integration by CVodeF(). `y`: a vector like the state. All references must
  // outlive this object.
  BackwardProblem(void* memory, const Model& model, const Options& options, int max_order, const Scales& scales,
                  AdjointEquations& equations, N_Vector y, CallbackContext& callbacks, Statistics& statistics,
                  SUNContext context);

  // Adds the jump at t_k; the first call, for the last t_k, starts the problem.
  void jump(std::size_t k, const State& state);
  // Begins anew at t, where a load has a kink. Precondition: jump() has been called.
  void restart(double t);
  // Integrates back to t (s).
  void integrate_to(double t);

  AdjointSolution solution();

 private:
  void start(double t);
  void set_quadrature_tolerances();
  void require(int flag) const;
  long steps_of_library() const;  // since the last restart
  int linearize(double t, N_Vector y, bool keep, double gamma, sunbooleantype* renewed);
  int right_hand_side(N_Vector y, N_Vector y_b, N_Vector y_b_dot, double t);
  // Computes out = K b at a state of the motion.
  void multiply_stiffness(double t, N_Vector y, const ConstVectorRef& b, VectorRef out);
  int products(double t, N_Vector y, N_Vector y_b, N_Vector out);

  void* memory_;
  const Model& model_;
  const Options& options_;
  int max_order_;  // of BDF
  Scales scales_;  // of the motion
  AdjointEquations& equations_;
  CallbackContext& callbacks_;
  Statistics& statistics_;
  SUNContext context_;
  int which_ = -1;
  bool is_started_ = false, is_linearized_ = false;
  long steps_ = 0;  // before the last restart
  double gamma_ = 0;
  NewtonMatrix matrix_;
  OwnedVector adjoint_, tolerance_, integral_;
  SolverFunctions functions_;
  OwnedMatrix placeholder_;
  OwnedSolver solver_;
  std::vector<double> stiffness_, damping_;  // entries of K, if it is constant, and of D; damping empty if it is 0
  Linearization tangent_;
  Vector work_;
};

}  // namespace orthodyn::sundials
