// What our own implicit one-step methods share: both ends of the last step, error control or a fixed step, dense
// output, counting and the messages of failure. A method says how to attempt a step.
//
// With error control a step is repeated until the norm of its local error is at most 1 (deadband_step_control.h). With
// a fixed step one without a solution is halved, up to 2^-10, and put together again: it stays one step. Where that
// does not help step() throws RunError with the time, the step and the remedy. Not thread-safe: one per run.
#pragma once

#include <string>

#include "integrators/native/deadband_step_control.h"
#include "integrators/native/native_options.h"
#include "integrators/scaled_norm.h"
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
  // Order of the method, and the power of h with which its error estimate falls.
  struct Orders {
    int method, estimate;
  };
  OneStep(std::string name, const Model& model, const LinearOptions& options, const Scales& scales);

  virtual Orders orders() const = 0;
  // Integrator::mean_state().
  virtual bool balances_by_mean_velocity() const { return false; }
  // now() is a new beginning: what is remembered of earlier steps does not hold.
  virtual void restarted() = 0;
  // One step of length h, s, from now() to next_, whose t is set: writes its q, v and a = M^-1 f. False if no solution
  // is found; a shorter step is tried then, as it is after a RecoverableError.
  virtual bool attempt(double h) = 0;
  // The local error of the last attempt in q, m, and in v, m/s.
  virtual void estimate(double h, VectorRef e_q, VectorRef e_v) = 0;
  // The last attempt, of length h, is taken: next_ is about to become now().
  virtual void accepted(double) {}
  virtual std::string solver_description() const = 0;
  virtual std::size_t method_bytes() const = 0;

  const StepEnd& now() const { return now_; }
  // f at a state, N. Throws RecoverableError if it is not finite.
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f);

  const Model& model_;
  Statistics statistics_;
  ScaledNorm norm_;
  StepEnd next_;

 private:
  enum class StepResult { good, error_test, newton, force };

  void advance_adaptively(double t_stop);
  void advance_by_fixed_step(double t_stop);
  double first_step(double t_stop);
  double length(double t_stop) const;
  StepResult try_step(double h);
  void accept(double h);
  void count(StepResult result);
  double resolution() const;  // of time at now()
  [[noreturn]] void give_up(StepResult result, double t, double h) const;

  std::string name_;
  LinearOptions options_;
  Scales scales_;
  DeadbandStepControl control_;
  double h_ = 0;             // the next step, if error control decides; 0 if it is still to be estimated
  double newton_limit_ = 0;  // a bound of the next step, where Newton has failed on a longer one
  double error_ = 0;         // of the last attempt, in units of what is allowed
  std::string cause_;        // why the model refused the last attempt, if it did
  StepEnd before_, now_;     // the ends of the last step
  Vector e_q_, e_v_;
};

}  // namespace orthodyn
