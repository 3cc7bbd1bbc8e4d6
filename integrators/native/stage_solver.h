// Newton's method for one implicit stage: find the acceleration x with
//
//     M x = f(t, q, v),    q = q* + w_k x,    v = v* + w_d x.
//
// Each correction solves (M + w_d D + w_k K) dx = f - M x. K, D and the factor outlive stages and steps: with
// `lazy` the factor is renewed when the weights have moved too far, and K and D when convergence is slow; a fixed step
// is tried with a new tangent for each iteration before it is given up. The
// iteration and what it remembers of its rate follow Hairer & Wanner (1996), IV.8.
#pragma once

#include "integrators/native/native_options.h"
#include "integrators/newton_matrix.h"
#include "integrators/scaled_norm.h"

namespace orthodyn {

class StageSolver {
 public:
  struct Stage {
    double t = 0;             // s
    Vector q, v;              // q*, v*
    double w_d = 0, w_k = 0;  // s, s^2
  };

  // Throws ConfigError if the linear solver does not take the model's matrices. `model` and `statistics`
  // must outlive this.
  StageSolver(const Model& model, const NewtonOptions& options, const ScaledNorm& norm, Statistics& statistics);

  // To be called when a new step begins, and when the state may be far from the last one.
  void begin_step();
  void restart() { stale_ = true; }

  // From a guess of x, m/s^2, to the solution, and q and v there. False if Newton's method does not converge. Throws
  // RecoverableError where the force cannot be evaluated.
  bool solve(const Stage& stage, VectorRef x, VectorRef q, VectorRef v);

  // (e_q, e_v) <- (I - w_d J)^-1 (e_q, e_v) with the last factor: what is stiff in an error estimate is damped as
  // it is in the solution (Shampine 1984; Hosea & Shampine 1996). For w_k = w_d^2 exact, else of the same size.
  void filter(VectorRef e_q, VectorRef e_v);

  std::size_t factor_bytes() const { return matrix_.factor_bytes(); }
  std::size_t bytes() const { return matrix_.bytes() + 4 * static_cast<std::size_t>(r_.size()) * sizeof(double); }
  std::string description() const { return matrix_.description(); }

 private:
  // Factors the stage's matrix, with a new tangent if `anew`. False if there is no factor.
  bool prepare(const Stage& stage, const ConstVectorRef& x, bool anew);
  double drift(const Stage& stage) const;
  void linearize(const Stage& stage, const ConstVectorRef& x);
  bool iterate(const Stage& stage, VectorRef x, VectorRef q, VectorRef v, bool renew_each_time);
  void correction(const Stage& stage, const ConstVectorRef& x, const ConstVectorRef& q, const ConstVectorRef& v);
  bool shrinks(double size, double last);

  const Model& model_;
  NewtonKind kind_;
  bool exhaustive_;  // a fixed step: a new tangent at each iteration is tried before the stage is given up
  double tolerance_;
  int max_iterations_;
  ScaledNorm norm_;
  Statistics& statistics_;
  NewtonMatrix matrix_;
  bool stale_ = true;  // K and D are to be made anew before they are used
  bool linearized_ = false, factored_ = false;
  double contraction_factor_ = 1;  // rate / (1 - rate) of the last iteration with this matrix factor
  Vector r_, dx_, guess_, work_;
};

}  // namespace orthodyn
