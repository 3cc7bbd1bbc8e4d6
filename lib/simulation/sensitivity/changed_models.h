// The models of a scene in which one number is changed by -2, -1, 1 and 2 steps, for derivatives with respect to it.
//
// A derivative is a difference of fourth order between four evaluations, none of which solves a system of equations.
// The step is 0.3 % (0.3 degrees), or less if the scene refuses such a value: the error of the difference is then about
// 1e-10, and rounding errors grow by 1 / 0.003 only. Any number may be the parameter whose changes keep the unknowns of
// the model and the connections of the mesh.
#pragma once

#include <type_traits>
#include <vector>

#include "lib/scene/build.h"
#include "lib/simulation/sensitivity/scene_parameter.h"

namespace orthodyn {

class ChangedModels {
 public:
  struct Changed {
    double change;  // of the parameter, SI units
    Scene scene;    // static; supports stand still
    BuiltScene built;
    const FemModel& model() const { return *built.model; }
  };

  // `scene`: resolved input of `original`. Throws ConfigError if the scene does not allow the changes, or if they
  // change the unknowns or the connections of the mesh.
  ChangedModels(const Config& scene, const FemModel& original, const SceneParameter& parameter);

  // df/dp per SI unit of the parameter, where `f` maps a Changed to a number or to an Eigen matrix.
  template <class F>
  auto derivative(const F& f) const {
    using Value = std::decay_t<decltype(f(models_[0]))>;
    const Value before_2 = f(models_[0]), before = f(models_[1]), after = f(models_[2]), after_2 = f(models_[3]);
    return Value((8 * (after - before) - (after_2 - before_2)) / (12 * step_));
  }

 private:
  double step_;
  std::vector<Changed> models_;  // in ascending order of the parameter
};

// Throws ConfigError unless the scene can be read with small changes of the parameter.
void require_changeable(const Config& scene, const SceneParameter& parameter);

}  // namespace orthodyn
