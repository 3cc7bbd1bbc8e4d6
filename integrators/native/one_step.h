// Base of the native implicit one-step methods, with both ends of the last step, error control or a fixed step, dense
// output, statistics and failure messages. A derived method implements attempt() and estimate().
//
// With error control a step is shortened until the norm of its local error is at most 1 (scaled_norm.h). If a fixed
// step has no solution, it is divided into substeps, down to 2^-10 of its length, and still counts as one step. If no
// solution is found, step() throws RunError with the time, the step and the remedy. Not thread-safe: one object per
// run.
#pragma once

#include <limits>
#include <string>

#include "integrators/native/native_options.h"
#include "integrators/native/step_controllers.h"
#include "integrators/scaled_norm.h"
#include "lib/core/cause.h"
#include "lib/core/errors.h"
#include "lib/ode/hermite.h"

namespace orthodyn {

class OneStep : public Integrator {
 public:
  void start(const State& state) override;
  StepInfo step(double t_stop) override;
  void interpolate(double t, State& out) const override;
  std::optional<State> mean_state() const override;
  bool adaptive() const override { return !options_.step; }
  const Statistics& statistics() const override { return statistics_; }
  std::size_t bytes() const override;
  Decisions decisions() const override;

 protected:
  // Order of the method, and the power of h to which its error estimate is proportional.
  struct Orders {
    int method, estimate;
  };
  OneStep(std::string name, const Model& model, const LinearOptions& options, const Scales& scales);

  virtual Orders orders() const = 0;
  // True if the energy balance uses Integrator::mean_state().
  virtual bool balances_by_mean_velocity() const { return false; }
  // Factor by which an adaptive step grows at most.
  virtual double largest_growth() const { return std::numeric_limits<double>::infinity(); }
  // Called when now() is a new initial state, to discard data of earlier steps.
  virtual void restarted() = 0;
  // Attempts one step of length h (s) from now() to next_: writes q, v and the acceleration a of next_, whose t is set,
  // and lambda if the model has constraints.
  // False if no solution is found. After false or a RecoverableError a shorter step is tried.
  virtual bool attempt(double h) = 0;
  // Estimates the local error of the last attempt: e_q in m, e_v in m/s.
  virtual void estimate(double h, VectorRef e_q, VectorRef e_v) = 0;
  // Called when the last attempt, of length h, is accepted, before next_ becomes now().
  virtual void accepted(double) {}
  virtual std::string solver_description() const = 0;
  virtual std::size_t method_bytes() const = 0;

  const StepEnd& now() const { return now_; }
  // Computes f (N) at a state. Throws RecoverableError if it is not finite.
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f);

  const Model& model_;
  Statistics statistics_;
  ScaledNorm norm_;
  StepEnd next_;

 private:
  enum class StepResult { good, error_test, newton, force };

  void advance_adaptively(double t_stop);
  void advance_by_fixed_step(double t_stop);
  // Computes the acceleration at a state, and the multipliers if the model has constraints.
  void accelerate(StepEnd& at);
  double first_step(double t_stop);
  double length(double t_stop) const;  // of the next step with error control, s
  StepResult try_step(double h);
  void accept(double h);
  void count(StepResult result);  // adds a failed attempt to the statistics
  double resolution() const;      // resolution (s) of floating-point time at now()
  [[noreturn]] void give_up(StepResult result, double t, double h) const;

  std::string name_;
  LinearOptions options_;
  Scales scales_;
  PredictiveStepController control_;
  double h_ = 0;             // next step with error control, s; 0 if still to be estimated
  double newton_limit_ = 0;  // bound of the next step after a longer one had no solution, s
  double error_ = 0;         // error of the last attempt in units of the tolerance
  Cause cause_;              // why the model refused the last attempt, if it did
  StepEnd before_, now_;     // the ends of the last step
  Vector e_q_, e_v_;
};

}  // namespace orthodyn
