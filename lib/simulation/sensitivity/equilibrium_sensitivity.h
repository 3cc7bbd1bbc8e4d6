// Derivatives of quantities in static equilibrium with respect to numbers of the scene.
//
// The equilibrium q(p) satisfies f(q, p) = 0. By the implicit function theorem K dq/dp = df/dp with K = -df/dq, which
// is one solution with one factor for all parameters. A quantity Q(q, p) has the derivative dQ/dp at fixed q, from
// changed models (changed_models.h), plus its derivative along dq/dp. No equilibrium of a changed scene is solved.
//
// Following loads and equilibria past a limit point are allowed; at a limit point K is singular, and there is no
// derivative.
#pragma once

#include <memory>
#include <vector>

#include "lib/linear/solver.h"
#include "lib/simulation/sensitivity/changed_models.h"
#include "lib/simulation/statics/static_problem.h"

namespace orthodyn {

class EquilibriumSensitivity {
 public:
  // `config`: resolved input of `scene` and `model`. `equilibrium`: at full load. All but the last argument must
  // outlive this object. Throws RunError if K cannot be factorised.
  EquilibriumSensitivity(const Config& config, const Scene& scene, const FemModel& model, const LoadPath& path,
                         State equilibrium);

  // Derivatives of outputs, per SI unit of the parameter. `kinematic`: the outputs depend on displacements only. Throws
  // ConfigError if changes of the parameter change the mesh's connections.
  Eigen::VectorXd derivatives(const SceneParameter& parameter, const SceneOutputs& outputs,
                              bool kinematic = false) const;

 private:
  const Config& config_;
  const Scene& scene_;
  const FemModel& model_;
  State equilibrium_;
  Linearization tangent_;
  std::vector<double> values_;  // of K; the factor refers to them
  std::unique_ptr<LinearSolver> factor_;
};

}  // namespace orthodyn
