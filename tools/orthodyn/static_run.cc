#include "tools/orthodyn/static_run.h"

#include <fmt/format.h>

#include "lib/simulation/load_steps.h"
#include "lib/simulation/vtu.h"
#include "lib/simulation/equilibrium.h"
#include "lib/simulation/machine.h"
#include "tools/orthodyn/interrupt.h"
#include "tools/orthodyn/report.h"
#include "lib/simulation/run_observers.h"

namespace orthodyn {

namespace {

// A line for each load step.
class LoadProgress : public Observer {
 public:
  explicit LoadProgress(const LoadStepper& stepper) : stepper_(stepper) {}
  void on_output(const State& state) override {
    fmt::print(stderr, "load factor {:.6g}: {} Newton iterations\n", state.t, stepper_.attempt().iterations);
  }

 private:
  const LoadStepper& stepper_;
};

class StaticObservers {
 public:
  StaticObservers(const Setup& setup, const StaticProblem& problem, const std::filesystem::path& folder, bool quiet) {
    const auto& output = setup.scene.output;
    if (!output.fields.empty()) frames_.emplace(folder, *problem.path, output.fields);
    if (output.steps) steps_.emplace(folder / "load_steps.csv", *problem.path, *problem.stepper);
    if (const auto columns = probe_columns(setup.scene, *setup.built.model); !columns.empty())
      probes_.emplace(folder / "probes.csv", *problem.path, columns, "load_factor");
    if (!quiet) progress_.emplace(*problem.stepper);
  }

  std::vector<Observer*> all() {
    std::vector<Observer*> out;
    const auto add = [&](auto& observer) { if (observer) out.push_back(&*observer); };
    add(frames_);
    add(steps_);
    add(probes_);
    add(progress_);
    return out;
  }

 private:
  std::optional<VtuWriter> frames_;
  std::optional<LoadStepWriter> steps_;
  std::optional<ProbeWriter> probes_;
  std::optional<LoadProgress> progress_;
};

struct Result {
  const Setup& setup;
  const StaticProblem& problem;
  const Outcome& outcome;
};

std::string finished_json(const RunArguments& arguments, const Result& result) {
  Json out = Json::parse(run_json(arguments, {}, nullptr));
  const auto& model = *result.setup.built.model;
  const auto& stepper = *result.problem.stepper;
  out["analysis"] = "static";
  out["status"] = status_word(result.outcome.status);
  out["model"] = {{"nodes", model.parts().mesh.nodes.size()},
                  {"elements", model.parts().mesh.tets.size()},
                  {"unknowns", model.num_dofs()},
                  {"terms", terms_json(model)}};
  out["load_factor_reached"] = result.outcome.last.t;
  out["loads_at_time"] = result.problem.path->time();
  out["load_steps"] = stepper.steps();
  out["rejected_load_steps"] = stepper.rejected();
  out["largest_displacement"] = result.outcome.last.q.lpNorm<Eigen::Infinity>();
  out["residual"] = stepper.attempt().residual;
  out["solver"] = result.problem.solver->description();
  out["statistics"] = to_json(result.problem.solver->statistics());
  out["wall_seconds"] = result.outcome.wall_seconds;
  out["cpu_seconds"] = result.outcome.cpu_seconds;
  if (result.outcome.status == Outcome::Status::failed)
    out["failure"] = {{"reason", reason_name(result.outcome.reason)}, {"message", result.outcome.message}};
  return out.dump(2) + "\n";
}

void print_result(const RunArguments& arguments, const Result& result, const std::filesystem::path& folder) {
  const auto& outcome = result.outcome;
  const auto& stepper = *result.problem.stepper;
  fmt::print("{}, static: {} unknowns, {} at load factor {:.6g} after {:.2f} s\n", arguments.scene,
             result.setup.built.model->num_dofs(), status_word(outcome.status), outcome.last.t, outcome.wall_seconds);
  fmt::print("  {:<20} {} ({} cut back), {} Newton iterations\n", "load steps", stepper.steps(), stepper.rejected(),
             result.problem.solver->statistics().newton_iterations);
  fmt::print("  {:<20} {}\n", "solver", result.problem.solver->description());
  fmt::print("  {:<20} {:.6g} m\n", "largest displacement", outcome.last.q.lpNorm<Eigen::Infinity>());
  fmt::print("  {:<20} {:.2g} N, {:.2g} of the largest load on a coordinate\n", "residual", stepper.attempt().residual,
             stepper.attempt().residual / std::max(result.problem.path->load().lpNorm<Eigen::Infinity>(), 1e-300));
  fmt::print("  {:<20} {}\n", "results", folder.string());
}

void warn_of_inversion(const Result& result) {
  const auto det_f = result.problem.path->evaluate("det_f.smallest", result.outcome.last);
  if (det_f[0] <= 0)
    fmt::print(stderr, "warning: element {} is inverted (det F = {:.3g}): this equilibrium has no meaning\n",
               static_cast<long>(det_f[1]), det_f[0]);
}

void refuse_what_is_for_motion(const RunArguments& arguments) {
  if (arguments.resume) throw ConfigError("--resume: a static analysis keeps no checkpoint; start anew with --force");
  if (arguments.estimate_error)
    throw ConfigError("--estimate-error: a static analysis has no error of integration; remove it");
}

}  // namespace

int run_static(const RunArguments& arguments, const Setup& setup, ResultFolder& folder, const std::string& resolved) {
  refuse_what_is_for_motion(arguments);
  const StaticProblem problem = static_problem(setup.scene, setup.built);
  folder.prepare();
  const ReservedFile record(folder.path() / "run.json", run_json(arguments, {}, nullptr));
  write_file(folder.path() / "scene.yaml", {resolved});
  StaticObservers observers(setup, problem, folder.path(), arguments.quiet);
  heed_interrupts();
  const Outcome outcome = run_static(*problem.stepper, observers.all(), interrupted());
  const Result result{setup, problem, outcome};
  if (outcome.status == Outcome::Status::failed) fmt::print(stderr, "error: {}\n", outcome.message);
  record.rewrite(finished_json(arguments, result));
  warn_of_inversion(result);
  if (!arguments.quiet) print_result(arguments, result, folder.path());
  return exit_code(outcome.status);
}

}  // namespace orthodyn
