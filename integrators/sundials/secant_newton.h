// Newton's method with the matrix of earlier steps, its corrections improved by the secants of the last two (Anderson
// 1965, type II of depth 2).
//
// With a matrix that is off by its gamma or by the motion since, corrections d_k = -A^-1 F(x_k) shrink by a constant
// factor along few directions. What the last steps x_i changed of d is known without another force:
//     dx = d_k - sum_i g_i (dx_i + dd_i),   g minimises |d_k - sum_i g_i dd_i|,
// with the norm of the error test. The matrix serves longer, and fewer are factorised.
//
// Its own test of convergence: the libraries judge the first correction, which no secant improves, by the rate of those
// of earlier steps, and would take it too soon.
#pragma once

#include <sundials/sundials_nonlinearsolver.h>

#include <array>

#include "integrators/sundials/callbacks.h"
#include "integrators/sundials/handles.h"
#include "lib/ode/vector_space.h"

namespace orthodyn::sundials {

class SecantNewton {
 public:
  // least_rate: corrections are known to shrink by this factor at best, where those of a direct solver may do better.
  // `space`: that of the model's vectors. `callbacks` takes exceptions of its sums over ranks past SUNDIALS' code.
  SecantNewton(N_Vector y, SUNContext context, CallbackContext& callbacks, const VectorSpace& space = {},
               double least_rate = 0);
  SecantNewton(const SecantNewton&) = delete;
  SecantNewton& operator=(const SecantNewton&) = delete;

  // To be handed to the library, whose test of convergence is ignored; this must outlive it.
  SUNNonlinearSolver get() const { return solver_.get(); }

  // With the vector that SUNDIALS' iteration has.
  std::size_t bytes() const { return (2 * kDepth + 2) * static_cast<std::size_t>(plain_.size()) * sizeof(double); }

 private:
  static constexpr int kDepth = 2;

  static SecantNewton& of(SUNNonlinearSolver solver) { return *static_cast<SecantNewton*>(solver->content); }
  void delegate();
  int solve(N_Vector y0, N_Vector y, N_Vector weights, sunrealtype tolerance, sunbooleantype set_up, void* memory);
  int correct(N_Vector b);  // the linear solve of one iteration, and what the secants make of it
  void take_in(VectorRef d);
  void improve(VectorRef d) const;
  int test(double size, double tolerance);
  int iteration() const;

  // SUNDIALS' own iteration does the work; what it calls comes through here.
  Owned<SUNNonlinearSolver, SUNNonlinSolFree> newton_, solver_;
  SUNNonlinSolSysFn system_ = nullptr;
  SUNNonlinSolLSetupFn set_up_ = nullptr;
  SUNNonlinSolLSolveFn solve_ = nullptr;
  CallbackContext& callbacks_;
  void* memory_ = nullptr;      // of the integrator
  N_Vector weights_ = nullptr;  // of this solve
  // dx_i + dd_i and dd_i, the latest first; between two iterations dx and -d of the last one.
  std::array<Vector, kDepth> change_, effect_;
  Vector plain_;   // d; nothing is allocated in SUNDIALS' calls
  int known_ = 0;  // secants
  // Sizes are norms of the error test.
  double first_size_ = 0, last_size_ = 0;  // of the first and the last correction of this solve
  double first_rate_ = 1;                  // by which the first correction leaves errors, from the last solves
  double least_rate_;
  VectorSpace space_;
  double rate_ = 1;  // by which corrections shrink
};

}  // namespace orthodyn::sundials
