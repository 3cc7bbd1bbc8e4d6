// Newton's method for one implicit stage: find the acceleration x with
//
//     M x = f(t, q, v),    q = q* + w_k x,    v = v* + w_d x.
//
// Each correction dx solves A dx = f - M x, A = M + w_d D + w_k K. K, D and the factor of A are kept across stages and
// steps. With `newton: lazy`, A is refactored if the weights have changed too much, and K and D are recomputed when
// this costs less than the iterations that it saves (renewal_policy.h) or when Newton's method fails. Before a fixed
// step fails, it is tried with a new tangent in each iteration. The iteration follows Hairer & Wanner (1996), IV.8.
//
// With constraints (lib/ode/constraints.h), the stage is M x = f - G^T lambda, g(t, q) = 0 with unknowns x and lambda.
// Each correction solves A dx + G^T dlambda = f - M x - G^T lambda, G dx = -g / w_k (constraints_at.h). As g is
// divided by w_k, the system is well conditioned for short steps too (Bottasso, Bauchau & Cardona 2007). Derivatives of
// G are left out; G of the matrix is renewed with K.
#pragma once

#include <optional>

#include "integrators/native/native_options.h"
#include "integrators/newton_matrix.h"
#include "integrators/remaining_error.h"
#include "integrators/renewal_policy.h"
#include "integrators/scaled_norm.h"
#include "lib/ode/constraints_at.h"

namespace orthodyn {

class StageSolver {
 public:
  struct Stage {
    double t = 0;             // s
    Vector q, v;              // q*, v*
    double w_d = 0, w_k = 0;  // s, s^2
  };

  // Throws ConfigError if the linear solver does not accept the model's matrices. `model` and `statistics`
  // must outlive this object.
  StageSolver(const Model& model, const NewtonOptions& options, const ScaledNorm& norm, Statistics& statistics);

  // Call begin_step() before the first stage of a step, and restart() if the state may be far from the last one.
  void begin_step();
  void restart() {
    stale_ = true;
    renewal_.restart();
  }

  // The multipliers of the constraints: the guess of solve(), and then its solution.
  const Vector& multipliers() const { return lambda_; }
  void guess_multipliers(const Vector& lambda) { lambda_ = lambda; }
  // The part of v along the constraints, by which it violates dg/dt = 0 at (t, q), with the last factor; zero if there
  // is none. Precondition: the model has constraints.
  Vector violation(double t, const ConstVectorRef& q, const ConstVectorRef& v);

  // In: a guess of x (m/s^2). Out: the solution x, and q and v there. False if Newton's method does not converge.
  // Throws RecoverableError if the force cannot be evaluated.
  bool solve(const Stage& stage, VectorRef x, VectorRef q, VectorRef v);

  // Multiplies (e_q, e_v) by (I - w_d J)^-1 with the last factor, where J is the Jacobian of (v, M^-1 f). This damps
  // the stiff part of an error estimate as the method damps it in the solution (Shampine 1984; Hosea & Shampine 1996).
  // The result is exact if w_k = w_d^2, else of the right magnitude. With constraints, which are the limit of stiff
  // springs, the parts of the estimate that violate them are removed.
  void filter(VectorRef e_q, VectorRef e_v);

  std::size_t factor_bytes() const { return matrix_.factor_bytes(); }
  std::size_t bytes() const {
    return matrix_.bytes() + 4 * static_cast<std::size_t>(r_.size()) * sizeof(double) +
           (constraints_at_ ? constraints_at_->bytes() : 0);
  }
  std::string description() const { return matrix_.description(); }

 private:
  bool try_solve(const Stage& stage, VectorRef x, VectorRef q, VectorRef v);
  // Factors the stage's matrix, with a new tangent if `renew`. False if the matrix cannot be factored.
  bool prepare(const Stage& stage, const ConstVectorRef& x, bool renew);
  double drift(const Stage& stage) const;
  void linearize(const Stage& stage, const ConstVectorRef& x);
  bool iterate(const Stage& stage, VectorRef x, VectorRef q, VectorRef v, bool renew_each_time);
  void correction(const Stage& stage, const ConstVectorRef& x, const ConstVectorRef& q, const ConstVectorRef& v);
  // Makes dx_ = A^-1 (f - M x - G^T lambda), for an A that was factored with weights 1 / `scale` times those of the
  // stage, fit the constraints, and corrects lambda.
  void correct_multipliers(const Stage& stage, const ConstVectorRef& q, double scale);

  const Model& model_;
  bool linear_;  // the matrix is constant: the model is linear and has no constraints
  NewtonKind kind_;
  bool exhaustive_;  // fixed step: before failing, tries a new tangent in each iteration
  double tolerance_;
  int max_iterations_;
  ScaledNorm norm_;
  Statistics& statistics_;
  NewtonMatrix matrix_;
  bool stale_ = true;  // K and D must be recomputed before use
  bool linearized_ = false, factored_ = false;
  RenewalPolicy renewal_;
  RemainingError remaining_;
  Vector r_, dx_, guess_, work_;
  const Constraints* constraints_;  // null if the model has none
  double t_ = 0;                    // s, with q_: at which K, D and G were computed
  Vector q_;
  std::optional<ConstraintsAt> constraints_at_;  // there, with A; only for models with constraints
  Vector lambda_, lambda_guess_, g_;
};

}  // namespace orthodyn
