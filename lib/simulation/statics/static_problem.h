// The static problem of a scene: load path, solver and load stepper.
#pragma once

#include <memory>

#include "lib/scene/build.h"
#include "lib/statics/load_path.h"

namespace orthodyn {

struct StaticProblem {
  std::unique_ptr<BuiltScene> own;  // model with general K, if loads make K unsymmetric; else null
  std::unique_ptr<LoadPath> path;   // from the unloaded shape
  std::unique_ptr<EquilibriumSolver> solver;
  std::unique_ptr<LoadStepper> stepper;
};

// Throws ConfigError at `clamps` if rigid motions remain at time t (s).
void require_held(const Scene& scene, const FemModel& model, double t);

// Loads are those at the end of the time span in statics, and at its start for `start: equilibrium`. If springs or
// ground contact act on the rest shape, the body first settles without loads. Throws ConfigError for a body that is not
// held, RunError for one that does not settle. `built` must outlive the problem.
StaticProblem static_problem(const Scene& scene, const BuiltScene& built);

// The unknowns of the unloaded shape: the equilibrium with springs and ground contact only; zero if these do not act on
// the rest shape. Precondition: the body is held. Throws RunError if it does not settle.
Vector unloaded_shape(const Scene& scene, const BuiltScene& built);

// The static scene for a dynamic scene at its start time. Supports stand still; `statics` gets its defaults if absent.
Scene at_rest(const Scene& scene);

// The unknowns in equilibrium, with supports standing still. Throws ConfigError like static_problem(), RunError if no
// equilibrium is found.
Vector equilibrium(const Scene& scene, const BuiltScene& built);

}  // namespace orthodyn
