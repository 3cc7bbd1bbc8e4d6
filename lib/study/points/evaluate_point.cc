#include "lib/study/points/evaluate_point.h"

#include <algorithm>
#include <chrono>

#include "lib/analysis/buckling.h"
#include "lib/scene/quantity.h"
#include "lib/simulation/error_estimate/estimated_error.h"
#include "lib/simulation/error_estimate/snapshot.h"
#include "lib/simulation/output/frames.h"
#include "lib/simulation/run/machine.h"
#include "lib/simulation/run/model_summary.h"
#include "lib/simulation/run/run.h"
#include "lib/simulation/run/setup.h"
#include "lib/simulation/run/several_ranks.h"
#include "lib/simulation/statics/load_steps.h"
#include "lib/simulation/statics/static_problem.h"
#include "lib/study/jobs/deadline.h"
#include "lib/study/quantities/metric.h"
#include "lib/study/quantities/wanted_modes.h"

namespace orthodyn::study {

namespace fs = std::filesystem;

namespace {

constexpr int kStatesOfMeshError = 8;

// The metrics of a quantity's course, side by side.
struct WantedQuantities {
  std::vector<const std::pair<std::string, WantedMetric>*> metrics;
  std::vector<Expectation> expectations;
  std::vector<Quantity> quantities;
};

WantedQuantities wanted_quantities(const EvaluationInput& input, const Setup& setup) {
  WantedQuantities wanted;
  for (const auto& metric : input.metrics) {
    const WantedMetric& f = metric.second;
    if (f.quantity.empty()) continue;
    wanted.metrics.push_back(&metric);
    Expectation& e = wanted.expectations.emplace_back();
    e.quantity = f.quantity, e.take = f.take, e.at = f.at, e.of = f.of;
    wanted.quantities.push_back(find_quantity(f.quantity, setup.scene, *setup.built.model, f.origin));
  }
  return wanted;
}

// The mesh's error is a diagnostic: what it takes is no cost of the motion.
class TimedMeshError : public MeshErrorRecorder {
 public:
  using MeshErrorRecorder::MeshErrorRecorder;
  void on_output(const ObservedState& observed) override {
    const auto begin = std::chrono::steady_clock::now();
    const double cpu = cpu_seconds_now();
    MeshErrorRecorder::on_output(observed);
    cpu_seconds += cpu_seconds_now() - cpu;
    wall_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  double cpu_seconds = 0, wall_seconds = 0;
};

class Evaluation {
 public:
  Evaluation(const Config& scene, const EvaluationInput& input, const fs::path& folder, const Ranks* ranks)
      : config_(scene), input_(input), folder_(folder), ranks_(ranks) {}

  EvaluationResult result() {
    if (wants([](const WantedMetric& f) { return !f.is_of_motion(); })) find_modes();
    if (input_.frame || wants([](const WantedMetric& f) { return f.is_of_motion(); })) follow_motion();
    return std::move(result_);
  }

 private:
  template <class Condition>
  bool wants(const Condition& condition) const {
    return std::any_of(input_.metrics.begin(), input_.metrics.end(),
                       [&](const auto& f) { return condition(f.second); });
  }

  void keep(const std::string& name, double value, const std::string& unit) {
    result_.metrics.emplace_back(name, value);
    result_.units.emplace_back(name, unit);
  }

  void keep(const MeshErrorRecorder& recorder) {
    if (const auto found = recorder.found()) result_.mesh_error = found->relative;
  }

  void describe(const FemModel& model) {
    result_.unknowns = static_cast<std::size_t>(model.num_dofs_of_all());
    result_.elements = model.parts().mesh.tets.size();
  }

  // Modes: nothing of the scene's integrator is set up.
  void find_modes() {
    if (ranks_) throw ConfigError("natural frequencies and buckling loads are computed by one process: no --ranks");
    const auto started = std::chrono::steady_clock::now();
    const double cpu = cpu_seconds_now();
    const Scene scene = read_scene(config_);
    const Scene still = scene.is_static() ? scene : at_rest(scene);
    const BuiltScene built = build(still);
    describe(*built.model);
    for (const bool about_equilibrium : {false, true}) find_modes(still, built, about_equilibrium);
    find_buckling(still, built);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - started;
    result_.cost = result_.modes_cost =
        EvaluationCost{cpu_seconds_now() - cpu - diagnostics_cpu_, wall.count() - diagnostics_wall_, {}, peak_memory()};
  }

  void find_modes(const Scene& scene, const BuiltScene& built, bool about_equilibrium) {
    std::vector<std::string> names;
    std::vector<WantedMetric> wanted;
    for (const auto& [name, f] : input_.metrics)
      if (!f.is_of_motion() && !f.buckling && f.about_equilibrium == about_equilibrium)
        names.push_back(name), wanted.push_back(f);
    if (wanted.empty()) return;
    const Vector zero = Vector::Zero(built.model->num_dofs());
    const State about{scene.time.end, about_equilibrium ? equilibrium(scene, built) : zero, zero,
                      about_equilibrium ? 1.0 : 0.0};
    const WantedModes found = wanted_modes(wanted, *built.model, about);
    for (std::size_t k = 0; k < names.size(); ++k)
      keep(names[k], found.chosen[k] ? found.modes.modes[*found.chosen[k]].frequency() : std::nan(""),
           wanted[k].unit_of(""));
    if (!input_.mesh_error || found.modes.modes.empty()) return;
    const auto begin = std::chrono::steady_clock::now();
    const double cpu = cpu_seconds_now();
    const FrequencyErrors errors = frequency_errors_of(scene, *built.model, about, found.modes);
    for (std::size_t k = 0; k < names.size(); ++k)
      if (found.chosen[k]) result_.metric_errors.emplace_back(names[k], errors.shares[*found.chosen[k]]);
    if (!errors.blind.empty()) result_.warnings.push_back(blindness_warning(errors.blind));
    diagnostics_cpu_ += cpu_seconds_now() - cpu;
    diagnostics_wall_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  void find_buckling(const Scene& scene, const BuiltScene& built) {
    int count = 0;
    for (const auto& [name, f] : input_.metrics) count = std::max(count, f.buckling.value_or(0));
    if (count == 0) return;
    require_held(scene, *built.model, scene.time.end);
    const auto modes = buckling_modes(*built.model, unloaded_shape(scene, built), scene.time.end, count).modes;
    for (const auto& [name, f] : input_.metrics) {
      if (!f.buckling) continue;
      const auto k = static_cast<std::size_t>(*f.buckling - 1);
      keep(name, k < modes.size() ? modes[k].load_factor : std::nan(""), "");
    }
  }

  void follow_motion() {
    start_again_if_outgrown(config_, [&](const Config& config, const std::string& given_up) {
      result_.failure.reset();
      Setup setup = set_up(config, false, true, ranks_);
      result_.warnings = setup.built.warnings;
      if (!given_up.empty()) {
        setup.note_given_up(given_up);
        given_up_ = *result_.cost;
      }
      follow_motion(setup);
      if (!setup.kinematics) return std::optional<Outgrown>();
      const auto outgrown = setup.linearity ? setup.linearity->why_to_start_again() : std::nullopt;
      if (!outgrown) result_.kinematics = told_kinematics(setup);
      return outgrown;
    });
  }

  void follow_motion(const Setup& setup) {
    describe(*setup.built.model);
    const WantedQuantities wanted = wanted_quantities(input_, setup);
    if (setup.scene.is_static()) find_equilibrium(setup, wanted);
    else integrate(setup, wanted);
    if (ranks_) add_up(*result_.cost);
    if (result_.failure || is_outgrown(setup)) return;
    const Json costs = to_json(*result_.cost);
    for (const auto& [name, f] : input_.metrics)
      if (!f.cost.empty()) keep(name, costs.at(f.cost).get<double>(), f.unit_of(""));
  }

  // What all ranks have taken together.
  void add_up(EvaluationCost& cost) const {
    for (double* value : {&cost.cpu_seconds, &cost.peak_memory}) *value = ranks_->sum(*value);
  }

  static bool is_outgrown(const Setup& setup) { return setup.linearity && setup.linearity->outgrown(); }

  void find_equilibrium(const Setup& setup, const WantedQuantities& wanted) {
    const StaticProblem problem = static_problem(setup.scene, setup.built);
    Deadline deadline(input_.seconds - given_up_.wall_seconds);
    const Outcome outcome = run_static(*problem.path, *problem.stepper, {&deadline}, deadline.over);
    Statistics statistics = problem.solver->statistics();
    statistics.steps = problem.stepper->steps();
    statistics.rejected_steps = problem.stepper->rejected();
    if (!conclude(outcome, statistics)) return;
    if (setup.kinematics && setup.linearity) setup.linearity->finish_at(problem.path->times().end, outcome.last.q);
    if (is_outgrown(setup)) return;
    const State state{problem.path->times().end, outcome.last.q, outcome.last.v};
    const ObservedState observed(*setup.built.model, state);
    for (std::size_t q = 0; q < wanted.metrics.size(); ++q)
      keep(wanted.metrics[q]->first, wanted.quantities[q].values(observed)[0], wanted.quantities[q].unit);
    MeshErrorRecorder mesh_error(0);
    if (input_.mesh_error) mesh_error.look_at(observed);
    keep(mesh_error);
    if (result_.mesh_error && !ranks_) {
      const MeshError found = look_closer(setup.scene, *setup.built.model, state, false, *mesh_error.found()).error;
      result_.mesh_error = found.relative;
      if (!found.blind.empty()) result_.warnings.push_back(blindness_warning(found.blind));
    }
    draw(*setup.built.model, state);
  }

  void integrate(const Setup& setup, const WantedQuantities& wanted) {
    SeriesRecorder recorder(*setup.built.model, *setup.integrator, wanted.quantities);
    Deadline deadline(input_.seconds - given_up_.wall_seconds);
    Snapshot frame(input_.frame_at);
    Plan plan{setup.scene.time.end, output_times(wanted.expectations, setup.scene.time), false};
    TimedMeshError mesh_error(plan.output_times.size());
    std::vector<Observer*> observers{&recorder, &deadline, &frame};
    if (input_.mesh_error) observers.push_back(&mesh_error);
    if (setup.kinematics && setup.linearity) observers.push_back(setup.linearity.get());
    EventFinder events(setup.events);
    if (!events.empty()) plan.events = &events;
    const Outcome outcome =
        run(*setup.built.model, *setup.integrator, setup.built.initial, plan, observers, deadline.over);
    const bool completed = conclude(outcome, setup.integrator->statistics());
    result_.cost->wall_seconds += setup.wall_seconds - mesh_error.wall_seconds;
    result_.cost->cpu_seconds += setup.cpu_seconds - mesh_error.cpu_seconds;
    if (setup.kinematics && setup.linearity) setup.linearity->finish();
    if (!completed || is_outgrown(setup)) return;
    for (std::size_t q = 0; q < wanted.metrics.size(); ++q) {
      const auto& [name, f] = *wanted.metrics[q];
      keep(name,
           f.settled_within ? settling_time(recorder.series(q), *f.settled_within)
                            : metric(wanted.expectations[q], recorder, q),
           f.unit_of(wanted.quantities[q].unit));
    }
    keep(mesh_error);
    draw(*setup.built.model, frame.state());
  }

  std::vector<double> output_times(std::vector<Expectation> wanted, const TimeSpan& time) const {
    if (input_.frame && input_.frame_at && *input_.frame_at < time.end) wanted.emplace_back().at = input_.frame_at;
    if (input_.mesh_error)
      for (int i = 1; i <= kStatesOfMeshError; ++i)
        wanted.emplace_back().at = time.start + (time.end - time.start) * i / kStatesOfMeshError;
    return times_asked_for(wanted, time.start);
  }

  // False if it did not get to its end, which is then the result.
  bool conclude(const Outcome& outcome, const Statistics& statistics) {
    result_.cost = EvaluationCost{given_up_.cpu_seconds + outcome.cpu_seconds,
                                  given_up_.wall_seconds + outcome.wall_seconds, statistics, peak_memory()};
    require_failure_of_all(ranks_, outcome);
    if (outcome.status != Outcome::Status::completed) result_.failure = failure_of(outcome, input_.seconds);
    return !result_.failure;
  }

  void draw(const FemModel& model, const State& state) {
    if (!input_.frame) return;
    std::vector<VtuField> fields;
    for (const auto& info : model.outputs())
      if (info.location != Location::global && (info.name == "displacement" || info.name == *input_.frame))
        fields.push_back({info.name, info.location, info.components, model.evaluate(info.name, state)});
    write_vtu(folder_ / kFrameFile, model.geometry(), fields, &model.parts().mesh);
    result_.frame = kFrameFile;
  }

  const Config& config_;
  const EvaluationInput& input_;
  const fs::path& folder_;
  const Ranks* ranks_;
  EvaluationResult result_;
  double diagnostics_cpu_ = 0, diagnostics_wall_ = 0;  // s, of estimates of errors: no cost of what is computed
  EvaluationCost given_up_;                            // of earlier attempts, with linear kinematics that were outgrown
};

}  // namespace

EvaluationResult evaluate_point(const Config& scene, const EvaluationInput& input, const fs::path& folder,
                                const Ranks* ranks) {
  return Evaluation(scene, input, folder, ranks).result();
}

void evaluate_point(const fs::path& folder, const Ranks* ranks) {
  serve_job(
      folder,
      [&](const Json& input) {
        return to_json(evaluate_point(Config::from_file((folder / kSceneFile).string()), evaluation_input_from(input),
                                      folder, ranks));
      },
      ranks);
}

}  // namespace orthodyn::study
