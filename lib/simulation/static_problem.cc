#include "lib/simulation/static_problem.h"

#include <fmt/format.h>

#include "lib/analysis/rigid_freedom.h"

namespace orthodyn {

void require_held(const Scene& scene, const FemModel& model, double t) {
  const std::string freedom = describe_rigid_freedom(model, t);
  if (freedom.empty()) return;
  const std::string message = fmt::format(
      "{}: it has no definite place at rest. Clamp it so that all six rigid motions are held (a surface, or three "
      "points that are not in line)",
      freedom);
  if (scene.clamps.empty()) throw ConfigError("clamps", message);
  scene.clamps.front().origin.fail(message);
}

StaticProblem static_problem(const Scene& scene, const BuiltScene& built) {
  const FemModel& model = *built.model;
  const double t = scene.is_static() ? scene.time.end : scene.time.start;
  require_held(scene, model, t);
  StaticProblem problem;
  const PathTimes times = scene.is_static() && model.parts().moved ? PathTimes(t - 1, t) : PathTimes(t);
  problem.path = std::make_unique<LoadPath>(model, times, Vector::Zero(model.num_dofs()));
  const double force = problem.path->largest_load();
  const double length = 0.1 * bounding_box(model.parts().mesh).size().maxCoeff();
  const Statics statics = scene.statics ? *scene.statics : Statics::spec().by_default();
  problem.solver = statics.solver->make(*problem.path, {force > 0 ? force : 1, length});
  problem.stepper = std::make_unique<LoadStepper>(*problem.path, *problem.solver, statics, length);
  return problem;
}

Scene at_rest(const Scene& scene) {
  Scene still = scene;
  still.analysis = Analysis::statical;
  still.time.end = scene.time.start;
  if (!still.statics) still.statics = Statics::spec().by_default();
  return still;
}

Vector equilibrium(const Scene& scene, const BuiltScene& built) {
  if (!scene.is_static() && !scene.motions.empty()) {
    const Scene still = at_rest(scene);
    return equilibrium(still, build(still, built.model->ranks()));
  }
  const StaticProblem problem = static_problem(scene, built);
  while (!problem.stepper->done()) problem.stepper->step();
  return problem.stepper->state().q;
}

}  // namespace orthodyn
