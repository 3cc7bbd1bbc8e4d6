// Products b . (df/dp - dM/dp q'') of a vector b with the derivatives of the equations of motion with respect to
// parameters, for adjoint equations. Stiffness factors cost one force of their elements (stiffness_cell.h), other
// parameters two forces of the body (changed_models.h).
#pragma once

#include <optional>
#include <vector>

#include "lib/simulation/sensitivity/changed_models.h"
#include "lib/simulation/sensitivity/stiffness_cell.h"

namespace orthodyn {

class ParameterProducts {
 public:
  // `config`: resolved input of `scene` and `built`, without kinematics: auto. All arguments must outlive this object.
  // Throws ConfigError for a parameter that changes the connections of the mesh or the time of a load's kink.
  ParameterProducts(const Config& config, const Scene& scene, const BuiltScene& built,
                    const std::vector<SceneParameter>& parameters);

  int count() const { return static_cast<int>(parameters_.size()); }

  // One product for each parameter, at a state of the motion, or of an equilibrium of a static scene. Throws
  // RecoverableError as Model::force() does.
  void compute(const State& state, const ConstVectorRef& b, VectorRef out) const;

  // Derivative of the state from which a scene starts that does not start from equilibrium.
  State initial_derivative(int i) const;

 private:
  struct Parameter {
    std::optional<StiffnessCell> cell;
    std::optional<ChangedModels> changed;  // if it is no cell
  };

  const FemModel& model_;
  bool is_static_;
  std::vector<Parameter> parameters_;
  bool needs_acceleration_ = false;
};

}  // namespace orthodyn
