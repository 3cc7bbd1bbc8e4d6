// What the Runge-Kutta methods of ARKODE share: creation and destruction of its memory, the step, adaptive or fixed,
// restarts where the force could not be evaluated, and dense output by the quintic through both ends of a step.
#pragma once

#include <arkode/arkode_arkstep.h>

#include <memory>
#include <optional>
#include <string>

#include "integrators/sundials/first_order.h"
#include "integrators/sundials/newton_at_kinks.h"
#include "lib/ode/hermite.h"

namespace orthodyn::sundials {

class ArkStep : public FirstOrderIntegrator {
 protected:
  // y' = explicit_part + implicit_part; either may be null. Callbacks get an ArkStep* as their user data.
  struct Parts {
    ARKRhsFn explicit_part = nullptr, implicit_part = nullptr;
  };
  ArkStep(const std::string& name, const Model& model, const Settings& settings, std::optional<double> step,
          const Parts& parts, int order)
      : FirstOrderIntegrator(name, model, settings), parts_(parts), step_(step), order_(order) {}

  // Sets tables, and Newton's method with attach_newton() where there is any.
  virtual void choose_method() = 0;
  // M^-1 f at y(): where the integration begins, and at the end of the step just taken.
  virtual void begin_acceleration(double t, VectorRef a) { initial_acceleration(model_, t, a); }
  virtual void end_acceleration(VectorRef a) = 0;

  void attach_newton();

  // A callback's body: take_known() at the end of the last step, where the derivative is known, else evaluate(), which
  // returns a flag. The first stage of the next step asks for it, and a force that could not be evaluated there would
  // end the integration.
  template <class TakeKnown, class Evaluate>
  int known_or_evaluated(double t, N_Vector y, TakeKnown&& take_known, Evaluate&& evaluate) {
    bool is_known = false;
    const int thrown = guarded(callback_context_, [&] {
      is_known = t == end_.t && model_.space().all(positions(y) == end_.q && velocities(y) == end_.v);
      if (is_known) take_known();
    });
    return thrown != 0 || is_known ? thrown : evaluate();
  }
  const StepEnd& end() const { return end_; }

  // The derivative of the last stage that was solved for, M^-1 f where that is the step's end.
  Eigen::Map<Vector> stage_acceleration() const;

  void* memory() const { return memory_.get(); }

  void initialise(double t) override;
  void reinitialise(double t) override;
  int advance(double t_stop, double& t) override;
  StepInfo last_step() const override;
  double current_step() const override;
  int dense_output(double t, N_Vector out) const override;
  Counters counters() const override;
  Reason classify(int flag) const override;
  std::size_t workspace_bytes() const override;
  bool adaptive() const override { return !step_; }

 private:
  struct FreeMemory {
    void operator()(void* memory) const { ARKStepFree(&memory); }
  };

  void begin_at(double t);
  void take_end(double t);
  bool retry_with_shorter_step();
  void attach_reduced();
  void attach_full();

  Parts parts_;
  std::optional<double> step_;
  int order_;
  long retries_ = 0;     // steps begun anew because a force could not be evaluated, since the last (re-)start
  StepEnd begin_, end_;  // of the last step
  std::optional<NewtonAtKinks> newton_;
  std::unique_ptr<void, FreeMemory> memory_;
};

}  // namespace orthodyn::sundials
