#include "lib/simulation/statics/static_problem.h"

#include <fmt/format.h>

#include "lib/analysis/rigid_freedom.h"

namespace orthodyn {

void require_held(const Scene& scene, const FemModel& model, double t) {
  const std::string freedom = describe_rigid_freedom(model, t);
  if (freedom.empty()) return;
  const std::string message = fmt::format(
      "{}, so its equilibrium is not unique. Clamp it so that all six rigid motions are held (a surface, or three "
      "points not in line)",
      freedom);
  if (scene.clamps.empty()) throw scene.places.placed(ConfigError("clamps", message));
  scene.clamps.front().origin.fail(message);
}

namespace {

Statics statics_of(const Scene& scene) { return scene.statics ? *scene.statics : Statics::spec().by_default(); }

double time_of_loads(const Scene& scene) { return scene.is_static() ? scene.time.end : scene.time.start; }

double size_of_motion(const FemModel& model) { return 0.1 * bounding_box(model.parts().mesh).size().maxCoeff(); }

struct Following {
  std::unique_ptr<EquilibriumSolver> solver;
  std::unique_ptr<LoadStepper> stepper;
};

Following follow(const Scene& scene, const LoadPath& path, double length) {
  const Statics statics = statics_of(scene);
  const double force = path.largest_load();
  Following out;
  out.solver = scene.places.with(
      [&] {
        return statics.solver->make(path, {force > 0 ? force : 1, length});
      },
      "statics");
  out.stepper = std::make_unique<LoadStepper>(path, *out.solver, statics, length);
  return out;
}

Vector settled(const Scene& scene, const FemModel& model, const PathTimes& times) {
  const auto path = LoadPath::settling(model, times, Vector::Zero(model.num_dofs()));
  if (!path) return Vector::Zero(model.num_dofs());
  const Following settling = follow(scene, *path, size_of_motion(model));
  try {
    while (!settling.stepper->done()) settling.stepper->step();
  } catch (const RunError& e) {
    throw RunError(fmt::format("the equilibrium without loads, with springs and contact, is not found: {}", e.what()),
                   e.reason());
  }
  return settling.stepper->state().q;
}

}  // namespace

StaticProblem static_problem(const Scene& scene, const BuiltScene& built) {
  const double t = time_of_loads(scene);
  require_held(scene, *built.model, t);
  StaticProblem problem;
  if (statics_of(scene).solver->takes_unsymmetric() && has_unsymmetric_load(scene, built.model->parts().mesh))
    problem.own = std::make_unique<BuiltScene>(build(scene, built.model->ranks(), MatrixStorage::general));
  const FemModel& model = problem.own ? *problem.own->model : *built.model;
  const PathTimes times = scene.is_static() && model.parts().moved ? PathTimes(t - 1, t) : PathTimes(t);
  problem.path = std::make_unique<LoadPath>(model, times, settled(scene, model, times));
  Following loading = follow(scene, *problem.path, size_of_motion(model));
  problem.solver = std::move(loading.solver);
  problem.stepper = std::move(loading.stepper);
  return problem;
}

Vector unloaded_shape(const Scene& scene, const BuiltScene& built) {
  return settled(scene, *built.model, time_of_loads(scene));
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
