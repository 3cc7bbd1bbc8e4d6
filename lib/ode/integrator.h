// An integrator advances one Model by steps of its own choice. One kind per file, chosen in the
// input by `type` through Registry<IntegratorChoice>.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/config/registry.h"
#include "lib/ode/integrator_settings.h"
#include "lib/ode/model.h"
#include "lib/ode/statistics.h"

namespace orthodyn {

struct StepInfo {
  double t = 0;  // the time reached
  double h = 0;
  int order = 0;
};

class Integrator {
 public:
  virtual ~Integrator() = default;

  // Begins, or begins anew after a breakpoint, at this state. Statistics go on.
  virtual void start(const State& state) = 0;

  // One step, ending at t_stop at the latest. Throws RunError with time, limit and remedy.
  virtual StepInfo step(double t_stop) = 0;

  // The solution at a time within the last step.
  virtual void interpolate(double t, State& out) const = 0;

  // True if error control chooses the step sizes. Adaptive steps are also limited by Model::step_limits().
  virtual bool adaptive() const { return true; }

  // False if interpolate() is less accurate than the steps, as between steps that span several periods of the motion.
  // The caller then ends steps at the output times.
  virtual bool has_accurate_interpolation() const { return true; }

  // Time (s) over which interpolate() is smooth; infinite if it is smooth over the whole last step. A caller that
  // samples within a step takes samples no further apart.
  virtual double smooth_time() const { return std::numeric_limits<double>::infinity(); }

  // Mean state of the last step: (q0 + q1)/2 with velocity (q1 - q0)/h. For methods whose energy balance holds with the
  // powers at that state: their velocities of stiff modes alternate in sign from step to step. None: powers are
  // integrated along interpolate().
  virtual std::optional<State> mean_state() const { return std::nullopt; }

  virtual const Statistics& statistics() const = 0;

  // Bytes of factorisations, workspace included, and of everything else that the integrator holds after start().
  virtual std::size_t factor_bytes() const { return 0; }
  virtual std::size_t bytes() const { return 0; }

  // Values chosen for keys that the input left open: pairs such as ("max_order", "5").
  virtual std::vector<std::pair<std::string, std::string>> decisions() const { return {}; }

  // Warnings about the motion so far: a sentence each, with a remedy.
  virtual std::vector<std::string> result_warnings() const { return {}; }
};

// Number of equal parts into which to divide a span h (s) within the last step for samples.
inline double smooth_parts(const Integrator& integrator, double h) {
  return std::ceil(h / std::min(h, integrator.smooth_time()));
}

// Sizes against which errors are measured: an error of rtol * position in every free coordinate, or
// of rtol * velocity in every velocity, is at tolerance.
struct Scales {
  double position = 1, velocity = 1;
  double omega = 0;  // rad/s, of the motion, about; 0 where it is not known
};

// What an integrator is wanted for.
struct Task {
  std::function<Scales()> scales;  // an estimate, asked for only if the input gives none
  State initial;
  double end = 0;              // s
  double output_interval = 0;  // s, about
};

// What a reader wants to know of a method before choosing it; a choice tells it by a static facts().
using MethodFacts = std::vector<std::pair<std::string, std::string>>;
inline MethodFacts method_facts(const std::string& order, const std::string& stability, const std::string& conserves,
                                const std::string& source) {
  return {{"order", order}, {"stability", stability}, {"conserves", conserves}, {"source", source}};
}

// The options of one integrator, read from the input; makes the integrator for a model. Implemented by way of
// SettableChoice (settable_choice.h).
class IntegratorChoice {
 public:
  virtual ~IntegratorChoice() = default;

  // The options that other methods may have too.
  virtual IntegratorSettings settings() const = 0;

  // The same options with those of the settings that have a value and that the method has. Throws ConfigError, without
  // a place, for a number outside of the range of its key. Conditions that join several keys are not checked.
  virtual std::unique_ptr<IntegratorChoice> with(const IntegratorSettings& settings) const = 0;

  // True for a method that serves models whose traits are `linear` alone.
  virtual bool needs_linear_model() const { return false; }

  // Whether it serves models of which several ranks have parts: all sums over entries of vectors then go by
  // Model::space().
  virtual bool runs_on_ranks() const { return false; }

  // Throws ConfigError if the integrator cannot serve the model, which must outlive it.
  virtual std::unique_ptr<Integrator> make(const Model& model, const Task& task) const = 0;
};

}  // namespace orthodyn
