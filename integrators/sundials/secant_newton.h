// Newton's method for F(x) = 0 with the matrix A of an earlier step. Each correction is improved by the last two
// secants (Anderson 1965, type II, depth 2).
//
// If gamma or the state has changed since A was factored, the corrections d_k = -A^-1 F(x_k) shrink only by a constant
// factor along a few directions. With the differences dx_i of successive iterates and dd_i of their corrections, the
// improved correction is
//
//     dx = d_k - sum_i g_i (dx_i + dd_i),
//
// where the g_i minimise |d_k - sum_i g_i dd_i| in the norm of the error test. This needs no additional force
// evaluation. Matrices remain useful for longer, so fewer are factored.
//
// This class has its own convergence test. The tests of CVODE, IDA and ARKODE judge the first correction by the
// convergence rate of earlier steps. They would accept it too early, because no secant has improved it.
#pragma once

#include <sundials/sundials_nonlinearsolver.h>

#include <array>

#include "integrators/sundials/callbacks.h"
#include "integrators/sundials/handles.h"
#include "lib/ode/vector_space.h"

namespace orthodyn::sundials {

class SecantNewton {
 public:
  // `least_rate`: smallest ratio of successive corrections; 0 with a direct solver (NewtonMatrix::least_rate()).
  // `space`: Model::space(). `callbacks` receives exceptions thrown by sums over ranks.
  SecantNewton(N_Vector y, SUNContext context, CallbackContext& callbacks, const VectorSpace& space = {},
               double least_rate = 0);
  SecantNewton(const SecantNewton&) = delete;
  SecantNewton& operator=(const SecantNewton&) = delete;

  // For CVODE, IDA or ARKODE, whose convergence test is then ignored. This object must outlive their memory block.
  SUNNonlinearSolver get() const { return solver_.get(); }

  // Memory (bytes), including the vector held by SUNDIALS' iteration.
  std::size_t bytes() const { return (2 * kDepth + 2) * static_cast<std::size_t>(plain_.size()) * sizeof(double); }

 private:
  static constexpr int kDepth = 2;

  static SecantNewton& of(SUNNonlinearSolver solver) { return *static_cast<SecantNewton*>(solver->content); }
  void delegate();
  int solve(N_Vector y0, N_Vector y, N_Vector weights, sunrealtype tolerance, sunbooleantype set_up, void* memory);
  int correct(N_Vector b);  // linear solve of one iteration, then the secants
  void store(VectorRef d);
  void apply_secants(VectorRef d) const;
  int test(double size, double tolerance);
  int iteration() const;

  // newton_ is SUNDIALS' iteration; solver_ forwards to it and intercepts its linear solves and its test.
  Owned<SUNNonlinearSolver, SUNNonlinSolFree> newton_, solver_;
  SUNNonlinSolSysFn system_ = nullptr;
  SUNNonlinSolLSetupFn set_up_ = nullptr;
  SUNNonlinSolLSolveFn solve_ = nullptr;
  CallbackContext& callbacks_;
  void* memory_ = nullptr;      // memory block of the integrator
  N_Vector weights_ = nullptr;  // error weights in this solve
  // dx_i + dd_i and dd_i, latest first. Between two iterations, entry 0 holds dx and -d of the last iteration.
  std::array<Vector, kDepth> change_, effect_;
  Vector plain_;                           // d without secants; allocated once, not in SUNDIALS' calls
  int known_ = 0;                          // number of secants
  double first_size_ = 0, last_size_ = 0;  // error-test norms of the first and the last correction in this solve
  double first_rate_ = 1;                  // factor by which a first correction reduces the error, from earlier solves
  double least_rate_;
  VectorSpace space_;
  double rate_ = 1;  // factor by which corrections shrink
};

}  // namespace orthodyn::sundials
