// What our own one-step methods without Newton iterations share: the ends of the last step, dense output between them,
// counting, and the messages of failure.
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
  // For messages: the integrator's name and what makes its steps shorter, and what makes them fewer.
  struct Words {
    std::string name, shorter, fewer;  // "lower integrator.step", "raise integrator.step"
  };
  ExplicitStep(const Model& model, const Words& words, int order, long max_steps);

  // A start or restart, at end().
  virtual void begin() {}
  // One step from end() to next_ (t, q, v and a), at t_stop at the latest. A RecoverableError becomes a RunError.
  virtual void advance(double t_stop) = 0;

  // a = M^-1 f, m/s^2. Throws RecoverableError where f cannot be evaluated or is not finite.
  void acceleration(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef a);

  // Throws RunError with the integrator, the time and what is wrong.
  [[noreturn]] void fail(const std::string& what, Reason reason) const;

  const StepEnd& end() const { return end_; }
  // Of the last step, for Integrator::mean_state(); none before the first.
  std::optional<State> mean_of_step() const;

  const Model& model_;
  Statistics statistics_;
  StepEnd next_;

 private:
  Words words_;
  int order_;
  long max_steps_;
  StepEnd begin_, end_;  // of the last step
};

}  // namespace orthodyn
