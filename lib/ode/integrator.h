// The interface of time integrators, which advance one Model step by step. One type per file, chosen in the input by
// `type` through Registry<IntegratorChoice>.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lib/config/registry.h"
#include "lib/ode/integrator_settings.h"
#include "lib/ode/model.h"
#include "lib/ode/statistics.h"

namespace orthodyn {

class SensitivityEquations;  // lib/ode/sensitivity_equations.h

struct StepInfo {
  double t = 0;  // the time reached
  double h = 0;
  int order = 0;
};

class Integrator {
 public:
  virtual ~Integrator() = default;

  // Starts at this state, or restarts after a breakpoint. A restart does not reset the statistics.
  virtual void start(const State& state) = 0;

  // Takes one step, which ends at t_stop at the latest. Throws RunError with time, limit and remedy.
  virtual StepInfo step(double t_stop) = 0;

  // Computes the solution at a time within the last step.
  virtual void interpolate(double t, State& out) const = 0;

  // Computes the derivative of the solution with respect to parameter i of Task::sensitivities, at a time within the
  // last step; before the first step, at the start. Precondition: the task has sensitivities.
  virtual void interpolate_sensitivity(int /*i*/, double /*t*/, State& /*out*/) const {
    throw std::logic_error("the integrator computes no sensitivities");
  }

  // True if error control chooses the step sizes. Adaptive steps are also limited by Model::step_limits().
  virtual bool adaptive() const { return true; }

  // False if interpolate() is less accurate than the steps, for example if a step spans several periods of the motion.
  // The caller then ends steps at the output times.
  virtual bool has_accurate_interpolation() const { return true; }

  // Time (s) over which interpolate() is smooth; infinite if it is smooth over the whole last step. A caller that
  // samples a step must not take samples further apart than this time.
  virtual double smooth_time() const { return std::numeric_limits<double>::infinity(); }

  // Mean state of the last step: (q0 + q1)/2 with velocity (q1 - q0)/h. Given by methods whose energy balance holds
  // with the powers at this state, because their velocities of stiff modes alternate in sign from step to step. Empty
  // for other methods, whose powers are integrated along interpolate().
  virtual std::optional<State> mean_state() const { return std::nullopt; }

  virtual const Statistics& statistics() const = 0;

  // Memory (bytes) of factorisations, workspace included, and of everything else that the integrator holds after
  // start().
  virtual std::size_t factor_bytes() const { return 0; }
  virtual std::size_t bytes() const { return 0; }

  // Values chosen for keys that the input left open: pairs such as ("max_order", "5").
  virtual std::vector<std::pair<std::string, std::string>> decisions() const { return {}; }

  // Warnings about the motion so far, each a sentence with a remedy.
  virtual std::vector<std::string> result_warnings() const { return {}; }
};

// Number of equal parts into which a span h (s) within the last step must be divided for samples.
inline double smooth_parts(const Integrator& integrator, double h) {
  return std::ceil(h / std::min(h, integrator.smooth_time()));
}

// Units of error tolerances. An error of rtol * position in every free coordinate and of rtol * velocity in every
// velocity is at the tolerance.
struct Scales {
  double position = 1, velocity = 1;  // m, m/s
  double omega = 0;                   // estimated angular frequency of the motion, rad/s; 0 if unknown
};

// The integration for which an integrator is made.
struct Task {
  std::function<Scales()> scales;  // estimates the scales; called only if the input does not give them
  State initial;
  double end = 0;              // s
  double output_interval = 0;  // approximate, s; 0 if unknown
  // Derivatives with respect to parameters, which are integrated with the motion; null if none are wanted. They must
  // outlive the integrator, and serve one integrator at a time.
  SensitivityEquations* sensitivities = nullptr;
};

// Properties of a method, shown in lists; the static facts() of a choice returns them.
using MethodFacts = std::vector<std::pair<std::string, std::string>>;
inline MethodFacts method_facts(const std::string& order, const std::string& stability, const std::string& conserves,
                                const std::string& source) {
  return {{"order", order}, {"stability", stability}, {"conserves", conserves}, {"source", source}};
}

// How a method integrates internal variables (internal_variables.h): not at all, as unknowns of its own, or only with
// fixed steps, by internal_history.h.
enum class InternalSupport { none, own, fixed_steps };

// The options of one integrator, read from the input. make() makes the integrator for a model. Implementations derive
// from SettableChoice (settable_choice.h).
class IntegratorChoice {
 public:
  virtual ~IntegratorChoice() = default;

  // The options that methods have in common.
  virtual IntegratorSettings settings() const = 0;

  // Returns a copy in which the given settings replace the options; settings that the method does not have are ignored.
  // Throws ConfigError, without file and line, for a number outside its key's range. Conditions on several keys are
  // not checked.
  virtual std::unique_ptr<IntegratorChoice> with(const IntegratorSettings& settings) const = 0;

  // True if the method accepts only models with traits().linear.
  virtual bool needs_linear_model() const { return false; }

  // True if the method accepts distributed models: it computes all sums over entries of vectors by Model::space().
  virtual bool runs_on_ranks() const { return false; }

  // True if the method integrates Task::sensitivities.
  virtual bool computes_sensitivities() const { return false; }

  virtual InternalSupport internal_support() const { return InternalSupport::none; }

  // True if the method integrates models with constraints (constraints.h).
  virtual bool solves_constraints() const { return false; }

  // Throws ConfigError if the integrator does not accept the model. The model must outlive the integrator.
  std::unique_ptr<Integrator> make(const Model& model, const Task& task) const;

 private:
  virtual std::unique_ptr<Integrator> make_for(const Model& model, const Task& task) const = 0;
};

}  // namespace orthodyn
