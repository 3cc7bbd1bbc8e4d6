// Base of central_differences and exponential_rosenbrock, which use no Newton matrix: both ends of the last step, dense
// output, statistics and failure messages. A derived method implements advance().
#pragma once

#include <string>

#include "lib/core/errors.h"
#include "lib/ode/hermite.h"
#include "lib/ode/integrator.h"

namespace orthodyn {

class ExplicitStep : public Integrator {
 public:
  void start(const State& state) override;
  StepInfo step(double t_stop) override;
  void interpolate(double t, State& out) const override;
  const Statistics& statistics() const override { return statistics_; }

 protected:
  // Texts for messages. name: type of the integrator; shorter: remedy that shortens steps ("lower integrator.step");
  // fewer: key that reduces the number of steps if raised ("integrator.step").
  struct Remedies {
    std::string name, shorter, fewer;
  };
  ExplicitStep(const Model& model, const Remedies& remedies, int order, long max_steps);

  // Called at a start or restart with the initial state, whose a is M^-1 f.
  virtual void begin(StepEnd&) {}
  // Takes one step from end() to next_ (t, q, v, a), which ends at t_stop at the latest. If it throws RecoverableError,
  // step() throws RunError.
  virtual void advance(double t_stop) = 0;

  // Computes a = M^-1 f (m/s^2). Throws RecoverableError if f cannot be evaluated or is not finite.
  void acceleration(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef a);

  // Throws RunError with the message "NAME stopped at t = ...: PROBLEM".
  [[noreturn]] void fail(const std::string& problem, Reason reason) const;

  const StepEnd& end() const { return end_; }
  // Returns the mean state of the last step, for Integrator::mean_state(); empty before the first step.
  std::optional<State> mean_of_step() const;

  const Model& model_;
  Statistics statistics_;
  StepEnd next_;

 private:
  Remedies remedies_;
  int order_;
  long max_steps_;
  StepEnd begin_, end_;  // ends of the last step
};

}  // namespace orthodyn
