// The models of a scene in which one number is changed by a few steps, for derivatives with respect to it.
//
// A derivative is a difference between evaluations of these models, none of which solves a system of equations. Any
// number may be the parameter whose changes keep the unknowns of the model and the connections of the mesh.
#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "lib/scene/build.h"
#include "lib/simulation/sensitivity/scene_parameter.h"

namespace orthodyn {

// The differences. four: of fourth order, between four models, with steps of 0.3 % (0.3 degrees): relative error about
// 1e-10, rounding errors grow by 1 / 0.003. two: of second order, between two models, with steps of 0.01 %: relative
// error about 1e-8, rounding errors grow by 1 / 0.0001. Steps are smaller if the scene refuses such a value.
enum class ChangeCount { two, four };

// Whether the changed scenes stand still at the start of the time span, or move as the scene does.
enum class ChangedMotion { still, as_given };

class ChangedModels {
 public:
  struct Changed {
    double change;  // of the parameter, SI units
    Scene scene;    // static with ChangedMotion::still
    BuiltScene built;
    const FemModel& model() const { return *built.model; }
  };

  // `scene`: resolved input of `original`. Throws ConfigError if the scene does not allow the changes, or if they
  // change the unknowns or the connections of the mesh.
  ChangedModels(const Config& scene, const FemModel& original, const SceneParameter& parameter,
                ChangeCount count = ChangeCount::four, ChangedMotion motion = ChangedMotion::still);

  // df/dp per SI unit of the parameter, where `f` maps a Changed to a number or to an Eigen matrix.
  template <class F>
  auto derivative(const F& f) const {
    using Value = std::decay_t<decltype(f(models_[0]))>;
    if (models_.size() == 2) {
      const Value before = f(models_[0]), after = f(models_[1]);
      return Value((after - before) / (2 * step_));
    }
    const Value before_2 = f(models_[0]), before = f(models_[1]), after = f(models_[2]), after_2 = f(models_[3]);
    return Value((8 * (after - before) - (after_2 - before_2)) / (12 * step_));
  }

  const std::vector<Changed>& models() const { return models_; }

 private:
  double step_;
  std::vector<Changed> models_;  // in ascending order of the parameter
};

// Numbers computed from a state of a scene, in SI units.
using SceneOutputs = std::function<Eigen::VectorXd(const Scene& scene, const FemModel& model, const State& state)>;

// The quantities of these names (lib/scene/quantity.h), which must be single numbers; NaN for the energy balance.
// Probes are at the nodes that they have in `model`, also in models with another mesh; points of gauges stay at their
// places.
SceneOutputs named_quantities(const std::vector<std::string>& names, const Scene& scene, const FemModel& model);

// Whether a quantity of a scene depends on displacements and velocities only, not on the stiffness. False if this is
// unknown.
bool is_kinematic(const std::string& quantity, const Scene& scene);

// A displacement for differences, 1e-4 of the smallest side of the body, in m: a slender body strongly resists larger
// straight displacements.
double small_displacement(const FemModel& model);

// The derivative of outputs along a direction of the state. Steps are at most `longest`, and displacements small.
Eigen::VectorXd derivative_along(const State& direction, double longest, const Scene& scene, const FemModel& model,
                                 const State& state, const SceneOutputs& outputs);

// The parameters at these paths. Throws ConfigError if a path is no number of the model or of the initial state, at
// `origin`, or if the scene does not allow small changes of it.
std::vector<SceneParameter> model_parameters(const Config& scene, const std::vector<std::string>& paths,
                                             const SourceLocation& origin);

// Throws ConfigError unless the scene can be read with small changes of the parameter.
void require_changeable(const Config& scene, const SceneParameter& parameter);

}  // namespace orthodyn
