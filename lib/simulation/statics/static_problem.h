// A scene's static problem: its loads at one time, the solver that it asks for, and the check that it is held.
#pragma once

#include <memory>

#include "lib/scene/build.h"
#include "lib/statics/load_path.h"

namespace orthodyn {

struct StaticProblem {
  std::unique_ptr<BuiltScene> own;  // of the path, where its K is unsymmetric by loads; else null
  std::unique_ptr<LoadPath> path;   // from the shape in which the body rests without loads
  std::unique_ptr<EquilibriumSolver> solver;
  std::unique_ptr<LoadStepper> stepper;
};

// Throws ConfigError, at the scene's clamps, for a body that has rigid motions left at time t, s.
void require_held(const Scene& scene, const FemModel& model, double t);

// The loads are those at the end of the time span in statics, at its start for a start from equilibrium. Where springs
// or the ground push at the body in its rest shape, it is first let settle without loads. Throws ConfigError for a body
// that is not held, RunError where it does not settle. `built` must outlive the problem.
StaticProblem static_problem(const Scene& scene, const BuiltScene& built);

// The free coordinates in which the body rests without loads, under the forces of springs and ground alone: zero where
// these do not push at its rest shape. Throws as above.
Vector unloaded_shape(const Scene& scene, const BuiltScene& built);

// The static counterpart of a dynamic scene: its body as it is at the start, with supports that stand still, and with
// the usual `statics` if it has none.
Scene at_rest(const Scene& scene);

// The free coordinates in equilibrium, with supports that stand still. Throws ConfigError as above, RunError where
// there is none to be found.
Vector equilibrium(const Scene& scene, const BuiltScene& built);

}  // namespace orthodyn
