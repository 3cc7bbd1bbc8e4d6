// Buckling analysis of a scene: writes buckling.csv, and the shapes as modes.pvd.
#include <fmt/format.h>

#include "lib/analysis/buckling.h"
#include "lib/core/errors.h"
#include "lib/simulation/modes/mode_files.h"
#include "lib/simulation/output/files.h"
#include "lib/simulation/run/model_summary.h"
#include "lib/simulation/run/run_context.h"
#include "lib/simulation/run/run_record.h"
#include "lib/simulation/sensitivity/buckling_sensitivity.h"
#include "lib/simulation/sensitivity/changed_models.h"
#include "lib/simulation/statics/static_problem.h"

namespace orthodyn {

namespace {

// Relative error of a shape's elastic energy due to the mesh, estimated from recovered stresses; it is also the
// relative error of the load factor. Shapes have the elastic energy 1/2, so that no division is needed.
double mesh_error(const FemModel& model, const State& rest, const Vector& shape) {
  const FemModel::Parts& parts = model.parts();
  const NodalExpansion about(parts, rest.t, rest.q, rest.v);
  NodalVector nodal = NodalVector::Zero(3, about.x.cols());
  parts.dofs->add_to(shape, nodal);
  const StressMisfit misfit = parts.recovery->misfit_along(nodal, about.state());
  return parts.recovery->product(misfit, misfit);
}

BucklingResult describe(const FemModel& model, const State& rest, const BucklingModes& found, int wanted) {
  BucklingResult result{.loads_at_time = rest.t, .wanted = wanted, .limit = found.limit};
  for (const BucklingMode& mode : found.modes)
    result.modes.push_back({mode.load_factor, mode.residual, mesh_error(model, rest, mode.shape)});
  return result;
}

void write(const std::filesystem::path& folder, const FemModel& model, const State& rest,
           const std::vector<BucklingMode>& modes, const BucklingResult& result) {
  CsvFile file(folder / "buckling.csv", {"mode", "load_factor", "mesh_error", "residual"});
  file.begin();
  std::vector<Vector> shapes;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const auto& mode = result.modes[k];
    file.row({static_cast<double>(k + 1), mode.load_factor, mode.mesh_error, mode.residual});
    shapes.push_back(modes[k].shape);
  }
  write_shapes(folder, model, rest, shapes);
}

// Without derivatives, the load factors are still a result.
void try_to_write_sensitivities(const RunContext& context, const State& rest, const BucklingModes& modes) {
  const Setup& setup = context.setup;
  if (setup.scene.sensitivities.empty()) return;
  try {
    const Config config = with_chosen_kinematics(setup.config);
    const auto parameters = model_parameters(config, setup.scene.sensitivities, setup.scene.sensitivities.origin);
    const auto sensitivities = buckling_sensitivities(config, *setup.built.model, rest.q, rest.t, modes, parameters);
    write_sensitivities(context.folder.path(), modes, sensitivities);
  } catch (const std::runtime_error& e) {  // ConfigError or RunError
    context.listener.on_warning(fmt::format("the sensitivities could not be computed: {}", e.what()));
  }
}

}  // namespace

RunResult run_buckling_analysis(RunContext context) {
  const Setup& setup = context.setup;
  const FemModel& model = *setup.built.model;
  const double t = setup.scene.time.end;
  require_held(setup.scene, model, t);
  if (!setup.scene.sensitivities.empty() && !model.traits().smooth)
    setup.scene.sensitivities.origin.fail(
        "are not computed with contact: the force has kinks, at which load factors have no derivative");
  context.folder.prepare();
  const auto& folder = context.folder.path();
  const RunRecord record(folder, context.scene, context.set, {}, setup.config);
  write_file(folder / "scene.yaml", {context.resolved});
  const State rest{t, unloaded_shape(setup.scene, setup.built), Vector::Zero(model.num_dofs())};
  RunResult result{.scene = context.scene, .folder = folder};
  result.buckling = BucklingResult{.loads_at_time = t};
  result.outcome = supervise(rest, {}, [&](Outcome& outcome) {
    const int count = setup.scene.buckling->count;
    const BucklingModes found = buckling_modes(model, rest.q, t, count);
    const auto& modes = found.modes;
    if (modes.empty())
      throw RunError(
          "these loads do not buckle the body: no positive critical load factor was found. Tensile loads do not buckle "
          "a body; nor is there buckling with linear kinematics, which have no stress stiffness");
    result.buckling = describe(model, rest, found, count);
    result.buckling->unsymmetric = has_unsymmetric_load(setup.scene, model.parts().mesh);
    write(folder, model, rest, modes, *result.buckling);
    try_to_write_sensitivities(context, rest, found);
    outcome.status = Outcome::Status::completed;
  });
  result.model = summarize(setup);
  record.finish(result);
  context.listener.on_result(result);
  return result;
}

}  // namespace orthodyn
