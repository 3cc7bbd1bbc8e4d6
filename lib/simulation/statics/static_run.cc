// Static analysis of a scene: load steps to the equilibrium at full load, and output files.
#include <fmt/format.h>

#include <limits>
#include <optional>

#include "lib/analysis/displacement_error.h"
#include "lib/core/spelling.h"
#include "lib/simulation/error_estimate/estimated_error.h"
#include "lib/simulation/output/files.h"
#include "lib/simulation/output/frames.h"
#include "lib/simulation/output/run_observers.h"
#include "lib/simulation/output/setup_file.h"
#include "lib/simulation/run/model_summary.h"
#include "lib/simulation/run/run_context.h"
#include "lib/simulation/run/run_record.h"
#include "lib/simulation/run/several_ranks.h"
#include "lib/simulation/sensitivity/sensitivity_table.h"
#include "lib/simulation/statics/load_steps.h"
#include "lib/simulation/statics/static_problem.h"

namespace orthodyn {

namespace {

// Reports each load step.
class LoadProgress : public Observer {
 public:
  LoadProgress(const LoadStepper& stepper, RunListener& listener) : stepper_(stepper), listener_(listener) {}
  void on_output(const ObservedState& observed) override {
    listener_.on_notice(fmt::format("load factor {:.6g}: {}", observed.t(),
                                    counted(stepper_.attempt().iterations, "Newton iteration")));
  }

 private:
  const LoadStepper& stepper_;
  RunListener& listener_;
};

class StaticObservers {
 public:
  StaticObservers(const Setup& setup, const StaticProblem& problem, const std::filesystem::path& folder,
                  RunListener& listener)
      : progress_(*problem.stepper, listener) {
    const auto& output = setup.scene.output;
    if (!output.fields.empty()) {
      frames_.emplace(folder, *problem.path, output.fields, &setup.built.model->parts().mesh);
      setup_.emplace(folder, setup);
    }
    if (output.steps) steps_.emplace(folder / "load_steps.csv", *problem.path, *problem.stepper);
    if (const auto columns = probe_columns(setup.scene, *setup.built.model); !columns.empty())
      probes_.emplace(folder / "probes.csv", *problem.path, columns, "load_factor");
    const FemModel& model = *setup.built.model;
    if (!output.extremes.empty()) extremes_.emplace(setup.scene, model);
    if (has_strain_limits(model)) strains_.emplace(StrainWatch::of_equilibria(model, problem.path->times()));
  }
  void copy_to(RunResult& result) const {
    if (extremes_) result.extremes = extremes_->found();
    if (strains_) result.exceeded_strain = strains_->worst();
  }

  std::vector<Observer*> all() {
    std::vector<Observer*> out;
    const auto add = [&](auto& observer) {
      if (observer) out.push_back(&*observer);
    };
    add(frames_);
    add(setup_);
    add(steps_);
    add(probes_);
    add(extremes_);
    add(strains_);
    out.push_back(&progress_);
    return out;
  }

 private:
  std::optional<FrameWriter> frames_;
  std::optional<SetupWriter> setup_;
  std::optional<LoadStepWriter> steps_;
  std::optional<ProbeWriter> probes_;
  std::optional<ExtremeRecorder> extremes_;
  std::optional<StrainWatch> strains_;
  LoadProgress progress_;
};

std::vector<int> probed_nodes(const Setup& setup) {
  std::vector<int> nodes;
  for (const auto& [name, probe] : setup.scene.output.probes)
    nodes.push_back(probe.node(setup.built.model->parts().mesh));
  return nodes;
}

// Errors of the displacements at `nodes`, by the dual problem; empty if the equilibrium is unstable.
std::vector<Vec3> dual_errors(const FemModel& model, const State& equilibrium, const std::vector<int>& nodes) {
  try {
    return displacement_errors(model, equilibrium, nodes);
  } catch (const RunError&) {  // unstable equilibrium
    return {};
  }
}

// Displacements of the probed nodes at the last equilibrium. `errors`: empty if unknown.
std::vector<ProbedDisplacement> probed_displacements(const Setup& setup, const State& equilibrium,
                                                     std::vector<Vec3> errors) {
  const FemModel& model = *setup.built.model;
  const std::vector<int> nodes = probed_nodes(setup);
  if (errors.empty()) errors.assign(nodes.size(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  const auto u = model.evaluate("displacement", equilibrium);
  std::vector<ProbedDisplacement> out;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    out.push_back({setup.scene.output.probes[i].first, Vec3(&u[3 * static_cast<std::size_t>(nodes[i])]), errors[i]});
  return out;
}

// `with_last`: false if only this rank failed; the results at the last equilibrium need all ranks.
EquilibriumResult equilibrium_result(const Setup& setup, const StaticProblem& problem, const Outcome& outcome,
                                     bool with_last) {
  const LoadStepper& stepper = *problem.stepper;
  EquilibriumResult out{.loads_at_time = problem.path->times().end,
                        .load_steps = stepper.steps(),
                        .rejected_load_steps = stepper.rejected(),
                        .jumps = stepper.jumps(),
                        .critical_points = stepper.critical_points(),
                        .unstable = stepper.unstable(),
                        .unsymmetric = !problem.path->pattern().symmetric,
                        .residual = stepper.attempt().residual,
                        .largest_load = problem.path->largest_load(),
                        .residual_above_tolerance = stepper.attempt().above_tolerance,
                        .solver = problem.solver->description(),
                        .statistics = problem.solver->statistics()};
  if (!with_last) return out;
  const State& last = outcome.last;
  out.largest_displacement = problem.path->space().largest_entry(last.q);
  const auto det_f = problem.path->evaluate("det_f.smallest", last);
  out.det_f = {det_f[0], static_cast<long>(det_f[1]), out.loads_at_time};
  MeshErrorRecorder mesh_error(0);
  if (setup.scene.output.mesh_error) mesh_error.observe({*problem.path, last});
  out.mesh_error = mesh_error.found();
  const FemModel& model = *setup.built.model;
  const State equilibrium{out.loads_at_time, last.q, Vector::Zero(last.q.size())};
  const std::vector<int> nodes = probed_nodes(setup);
  std::vector<Vec3> errors;
  // No error can be estimated below full load, where the state is not an equilibrium of `model`.
  if (setup.scene.output.mesh_error && outcome.status == Outcome::Status::completed) {
    if (out.mesh_error) {
      StateMeshError found = estimate_mesh_error(setup.scene, model, equilibrium, false, *out.mesh_error, nodes);
      out.mesh_error = found.error;
      errors = std::move(found.displacements);
    }
    if (errors.empty() && !nodes.empty()) errors = dual_errors(model, equilibrium, nodes);
  }
  out.probes = probed_displacements(setup, equilibrium, std::move(errors));
  return out;
}

// Derivatives at full load.
void write_sensitivities(const Setup& setup, const StaticProblem& problem, const State& last,
                         const std::filesystem::path& folder) {
  const Scene& scene = setup.scene;
  if (scene.sensitivities.empty()) return;
  const Config config = with_chosen_kinematics(setup.config);
  const auto parameters = model_parameters(config, scene.sensitivities, scene.sensitivities.origin);
  const FemModel& model = *setup.built.model;
  const State equilibrium{problem.path->times().end, last.q, Vector::Zero(last.q.size())};
  const EquilibriumSensitivity sensitivity(config, scene, model, *problem.path, equilibrium);
  orthodyn::write_sensitivities(folder / "sensitivities.csv", scene, model, sensitivity, parameters);
}

// Without derivatives, the equilibrium is still a result.
void try_to_write_sensitivities(const RunContext& context, const StaticProblem& problem, const State& last) {
  try {
    write_sensitivities(context.setup, problem, last, context.folder.path());
  } catch (const std::runtime_error& e) {  // ConfigError or RunError
    context.listener.on_warning(fmt::format("the sensitivities could not be computed: {}", e.what()));
  }
}

}  // namespace

RunResult run_static_analysis(RunContext context) {
  const Setup& setup = context.setup;
  const auto& folder = context.folder.path();
  const StaticProblem problem = static_problem(setup.scene, setup.built);
  if (!setup.scene.sensitivities.empty()) sensitivity_quantities(setup.scene, *setup.built.model);  // throws
  context.folder.prepare();
  const RunRecord record(folder, context.scene, context.set, {}, context.setup.config);
  write_file(folder / "scene.yaml", {context.resolved});
  StaticObservers observers(setup, problem, folder, context.listener);
  auto all = observers.all();
  const auto own = context.listener.on_begin(setup);
  if (own) all.insert(all.begin(), own.get());  // called first; the writers can reuse the values it evaluates
  RunResult result{.scene = context.scene, .folder = folder};
  result.ranks = num_ranks(context.request.ranks);
  result.outcome = run_static(*problem.path, *problem.stepper, all, context.interrupt);
  result.only_this_rank_failed =
      result.outcome.status == Outcome::Status::failed && only_this_rank_failed(problem.path->ranks());
  if (!result.only_this_rank_failed) result.outcome.cpu_seconds = problem.path->space().sum(result.outcome.cpu_seconds);
  if (setup.linearity && result.outcome.status != Outcome::Status::interrupted) {
    setup.linearity->finish_at(problem.path->times().end, result.outcome.last.q);
    result.kinematics_restart = setup.linearity->kinematics_restart();
    if (result.kinematics_restart) return result;
  }
  result.model = summarize(setup);
  observers.copy_to(result);
  result.equilibrium = equilibrium_result(setup, problem, result.outcome, !result.only_this_rank_failed);
  record.finish(result);
  if (result.outcome.status == Outcome::Status::completed)
    try_to_write_sensitivities(context, problem, result.outcome.last);
  context.listener.on_result(result);
  return result;
}

}  // namespace orthodyn
