// Evaluates one point: computes the metrics of its scene.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "lib/analysis/buckling.h"
#include "lib/scene/quantity.h"
#include "lib/simulation/error_estimate/estimated_error.h"
#include "lib/simulation/error_estimate/recorders.h"
#include "lib/simulation/output/frames.h"
#include "lib/simulation/run/machine.h"
#include "lib/simulation/run/model_summary.h"
#include "lib/simulation/run/run.h"
#include "lib/simulation/run/setup.h"
#include "lib/simulation/run/several_ranks.h"
#include "lib/simulation/sensitivity/buckling_sensitivity.h"
#include "lib/simulation/sensitivity/equilibrium_sensitivity.h"
#include "lib/simulation/sensitivity/frequency_sensitivity.h"
#include "lib/simulation/sensitivity/response_sensitivity.h"
#include "lib/simulation/statics/load_steps.h"
#include "lib/simulation/statics/static_problem.h"
#include "lib/study/jobs/deadline.h"
#include "lib/study/points/evaluation.h"
#include "lib/study/points/slope_recorder.h"
#include "lib/study/quantities/response_metric.h"
#include "lib/study/quantities/series.h"
#include "lib/study/quantities/wanted_modes.h"

namespace orthodyn::study {

namespace fs = std::filesystem;

namespace {

constexpr int kMeshErrorStates = 8;

// The requested metrics of quantities; the first three lists have the same order.
struct WantedQuantities {
  std::vector<const std::pair<std::string, WantedMetric>*> metrics;
  std::vector<Expectation> expectations;
  std::vector<std::size_t> index;    // in `quantities`
  std::vector<Quantity> quantities;  // without repetition

  const Quantity& quantity(std::size_t metric) const { return quantities[index[metric]]; }
};

WantedQuantities wanted_quantities(const EvaluationInput& input, const Setup& setup) {
  WantedQuantities wanted;
  for (const auto& metric : input.metrics) {
    const WantedMetric& m = metric.second;
    if (m.quantity.empty() || setup.scene.harmonic) continue;
    wanted.metrics.push_back(&metric);
    Expectation& e = wanted.expectations.emplace_back();
    e.quantity = m.quantity, e.take = m.take, e.at = m.at, e.of = m.of;
    const auto known = std::ranges::find(wanted.quantities, m.quantity, &Quantity::name);
    wanted.index.push_back(static_cast<std::size_t>(known - wanted.quantities.begin()));
    if (known == wanted.quantities.end())
      wanted.quantities.push_back(find_quantity(m.quantity, setup.scene, *setup.built.model, m.origin));
  }
  return wanted;
}

// CPU and wall time since its construction, s.
class Stopwatch {
 public:
  double cpu() const { return cpu_seconds_now() - cpu_; }
  double wall() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

 private:
  double cpu_ = cpu_seconds_now();
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

// Measures its own time, because the estimate is not part of a point's cost.
class TimedMeshError : public MeshErrorRecorder {
 public:
  using MeshErrorRecorder::MeshErrorRecorder;
  void on_output(const ObservedState& observed) override {
    const Stopwatch watch;
    MeshErrorRecorder::on_output(observed);
    cpu_seconds += watch.cpu();
    wall_seconds += watch.wall();
  }
  double cpu_seconds = 0, wall_seconds = 0;
};

class Evaluation {
 public:
  Evaluation(const Config& scene, const EvaluationInput& input, const fs::path& folder, const Ranks* ranks)
      : config_(scene), input_(input), folder_(folder), ranks_(ranks) {}

  EvaluationResult result() {
    if (wants([](const WantedMetric& m) { return !m.is_of_motion(); })) find_modes();
    if (input_.frame || wants([](const WantedMetric& m) { return m.is_of_motion(); })) follow_motion();
    return std::move(result_);
  }

 private:
  template <class Condition>
  bool wants(const Condition& condition) const {
    return std::any_of(input_.metrics.begin(), input_.metrics.end(),
                       [&](const auto& m) { return condition(m.second); });
  }

  void keep(const std::string& name, double value, const std::string& unit) {
    result_.metrics.emplace_back(name, value);
    result_.units.emplace_back(name, unit);
  }

  void keep(const MeshErrorRecorder& recorder) {
    if (const auto found = recorder.found()) result_.mesh_error = found->relative;
  }

  void describe(const FemModel& model) {
    result_.model = {static_cast<std::size_t>(model.num_dofs_of_all()), model.parts().mesh.cells.size()};
  }

  // Does not set up the scene's integrator, which modes do not need.
  void find_modes() {
    if (ranks_) throw ConfigError("natural frequencies and buckling loads are computed by one process: remove --ranks");
    const Stopwatch watch;
    const Scene scene = read_scene(config_);
    const Scene still = scene.is_static() ? scene : at_rest(scene);
    const BuiltScene built = build(still);
    describe(*built.model);
    for (const bool about_equilibrium : {false, true}) find_modes(still, built, about_equilibrium);
    find_buckling(still, built);
    EvaluationCost cost;
    cost.cpu_seconds = watch.cpu() - diagnostics_cpu_;
    cost.wall_seconds = watch.wall() - diagnostics_wall_;
    cost.peak_memory = peak_memory();
    result_.cost = result_.modes_cost = cost;
  }

  void find_modes(const Scene& scene, const BuiltScene& built, bool about_equilibrium) {
    std::vector<std::string> names;
    std::vector<WantedMetric> wanted;
    for (const auto& [name, m] : input_.metrics)
      if (!m.is_of_motion() && !m.buckling && m.about_equilibrium == about_equilibrium)
        names.push_back(name), wanted.push_back(m);
    if (wanted.empty()) return;
    const Vector zero = Vector::Zero(built.model->num_dofs());
    const State about{scene.time.end, about_equilibrium ? equilibrium(scene, built) : zero, zero,
                      about_equilibrium ? 1.0 : 0.0};
    const auto& matchings = about_equilibrium ? std::vector<ModeMatching>{} : input_.matchings;
    const WantedModes found = wanted_modes(wanted, *built.model, about, matchings);
    for (std::size_t k = 0; k < names.size(); ++k) {
      keep(names[k], found.chosen[k] ? found.modes.modes[*found.chosen[k]].frequency() : std::nan(""),
           wanted[k].unit_of(""));
      if (found.matches[k]) result_.matches.emplace_back(names[k], *found.matches[k]);
    }
    if (!about_equilibrium) find_derivatives(names, found, *built.model, about);
    if (!input_.mesh_error || found.modes.modes.empty()) return;
    const Stopwatch watch;
    const FrequencyErrors errors = frequency_errors_of(scene, *built.model, about, found.modes);
    for (std::size_t k = 0; k < names.size(); ++k)
      if (found.chosen[k]) result_.metric_errors.emplace_back(names[k], errors.shares[*found.chosen[k]]);
    if (!errors.locking_risk.empty()) result_.warnings.push_back(locking_warning(errors.locking_risk));
    diagnostics_cpu_ += watch.cpu();
    diagnostics_wall_ += watch.wall();
  }

  void find_derivatives(const std::vector<std::string>& names, const WantedModes& found, const FemModel& model,
                        const State& rest) {
    const auto slopes = frequency_sensitivities(config_, model, rest, found.modes, parameters());
    if (slopes.empty()) return;
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (!found.chosen[k]) continue;
      std::vector<double>& own = result_.derivatives.emplace_back(names[k], std::vector<double>{}).second;
      for (const FrequencySensitivity& slope : slopes) own.push_back(slope.derivatives[*found.chosen[k]]);
    }
  }

  std::vector<SceneParameter> parameters() const { return scene_parameters(config_, input_.parameters); }

  void find_buckling(const Scene& scene, const BuiltScene& built) {
    int count = 0;
    for (const auto& [name, m] : input_.metrics) count = std::max(count, m.buckling.value_or(0));
    if (count == 0) return;
    require_held(scene, *built.model, scene.time.end);
    const double t = scene.time.end;
    const Vector unloaded = unloaded_shape(scene, built);
    const BucklingModes found = buckling_modes(*built.model, unloaded, t, count);
    const bool has_slopes = built.model->traits().smooth;
    const auto slopes = buckling_sensitivities(config_, *built.model, unloaded, t, found,
                                               has_slopes ? parameters() : std::vector<SceneParameter>{});
    for (const auto& [name, m] : input_.metrics) {
      if (!m.buckling) continue;
      const auto k = static_cast<std::size_t>(*m.buckling - 1);
      const bool exists = k < found.modes.size();
      keep(name, exists ? found.modes[k].load_factor : std::nan(""), "");
      if (!exists || slopes.empty()) continue;
      std::vector<double>& own = result_.derivatives.emplace_back(name, std::vector<double>{}).second;
      for (const BucklingSensitivity& slope : slopes) own.push_back(slope.derivatives[k]);
    }
  }

  void follow_motion() {
    run_with_kinematics_restarts(with_sensitivities(), [&](const Config& config, const std::string& restart_reason) {
      result_.failure.reset();
      Setup setup = set_up(config, false, true, ranks_);
      result_.warnings = setup.built.warnings;
      if (!restart_reason.empty()) {
        setup.note_kinematics_restart(restart_reason);
        given_up_ = *result_.cost;
      }
      follow_motion(setup);
      if (!setup.kinematics) return std::optional<KinematicsRestart>();
      const auto restart = setup.linearity ? setup.linearity->kinematics_restart() : std::nullopt;
      if (!restart) result_.kinematics = kinematics_summary(setup);
      return restart;
    });
  }

  // The scene; with the parameters as its `sensitivities` if values of a motion have derivatives.
  Config with_sensitivities() const {
    Config copy = config_.copy();
    const auto at_time = [](const WantedMetric& m) { return m.at.has_value(); };
    const bool has_own = copy.is_map() && copy.has("sensitivities");
    if (has_own) copy.set_yaml("sensitivities", "[]");
    if (!input_.parameters.empty() && wants(at_time) &&
        has_motion_sensitivity(copy, read_scene(copy), input_.parameters))
      copy.set_yaml("sensitivities", fmt::format("[{}]", fmt::join(input_.parameters, ", ")));
    return copy;
  }

  void follow_motion(const Setup& setup) {
    describe(*setup.built.model);
    const WantedQuantities wanted = wanted_quantities(input_, setup);
    if (setup.scene.harmonic) find_response(setup);
    else if (setup.scene.is_static()) find_equilibrium(setup, wanted);
    else integrate(setup, wanted);
    if (ranks_) sum_over_ranks(*result_.cost);
    if (result_.failure || exceeds_allowed_error(setup)) return;
    const Json costs = to_json(*result_.cost);
    for (const auto& [name, m] : input_.metrics)
      if (!m.cost.empty()) keep(name, costs.at(m.cost).get<double>(), m.unit_of(""));
  }

  // Sums CPU time and memory over all ranks.
  void sum_over_ranks(EvaluationCost& cost) const {
    for (double* value : {&cost.cpu_seconds, &cost.peak_memory}) *value = ranks_->sum(*value);
  }

  static bool exceeds_allowed_error(const Setup& setup) {
    return setup.linearity && setup.linearity->exceeds_allowed();
  }

  void find_equilibrium(const Setup& setup, const WantedQuantities& wanted) {
    const StaticProblem problem = static_problem(setup.scene, setup.built);
    Deadline deadline(input_.seconds - given_up_.wall_seconds);
    const Outcome outcome = run_static(*problem.path, *problem.stepper, {&deadline}, deadline.over);
    Statistics statistics = problem.solver->statistics();
    statistics.steps = problem.stepper->steps();
    statistics.rejected_steps = problem.stepper->rejected();
    if (!conclude(outcome, statistics)) return;
    if (setup.kinematics && setup.linearity) setup.linearity->finish_at(problem.path->times().end, outcome.last.q);
    if (exceeds_allowed_error(setup)) return;
    const State state{problem.path->times().end, outcome.last.q, outcome.last.v};
    const ObservedState observed(*setup.built.model, state);
    for (std::size_t q = 0; q < wanted.metrics.size(); ++q)
      keep(wanted.metrics[q]->first, wanted.quantity(q).values(observed)[0], wanted.quantity(q).unit);
    const Stopwatch of_derivatives;
    find_derivatives(setup, *problem.path, state, wanted);
    if (!input_.parameters.empty()) result_.cost->cpu_seconds += of_derivatives.cpu();
    MeshErrorRecorder mesh_error(0);
    if (input_.mesh_error) mesh_error.observe(observed);
    keep(mesh_error);
    if (result_.mesh_error && !ranks_) {
      const MeshError found =
          estimate_mesh_error(setup.scene, *setup.built.model, state, false, *mesh_error.found()).error;
      result_.mesh_error = found.relative;
      if (!found.locking_risk.empty()) result_.warnings.push_back(locking_warning(found.locking_risk));
    }
    draw(*setup.built.model, state);
  }

  void find_derivatives(const Setup& setup, const LoadPath& path, const State& equilibrium,
                        const WantedQuantities& wanted) {
    const auto all = parameters();
    if (all.empty() || wanted.metrics.empty()) return;
    const Config config = with_chosen_kinematics(setup.config);
    const EquilibriumSensitivity sensitivity(config, setup.scene, *setup.built.model, path, equilibrium);
    std::vector<std::string> names;
    for (const auto* metric : wanted.metrics) {
      names.push_back(metric->second.quantity);
      result_.derivatives.emplace_back(metric->first, std::vector<double>{});
    }
    auto* const first = &result_.derivatives[result_.derivatives.size() - names.size()];
    const SceneOutputs outputs = named_quantities(names, setup.scene, *setup.built.model);
    const bool kinematic =
        std::ranges::all_of(names, [&](const auto& name) { return is_kinematic(name, setup.scene); });
    for (const SceneParameter& parameter : all) {
      const auto slopes = sensitivity.derivatives(parameter, outputs, kinematic);
      for (std::size_t i = 0; i < names.size(); ++i) first[i].second.push_back(slopes[static_cast<Eigen::Index>(i)]);
    }
  }

  void find_response(const Setup& setup) {
    std::optional<HarmonicResponse> response;
    if (!conclude(supervise(setup.built.initial, {}, [&](Outcome&) { response.emplace(setup); }), {})) return;
    for (const auto& [name, m] : input_.metrics) {
      if (m.quantity.empty()) continue;
      const std::size_t column = find_column(response->columns(), m.quantity, m.origin);
      keep(name, metric(*response, column, m.response_metric(), m.frequency),
           metric_unit(m.response_metric(), response->columns()[column].unit));
    }
    find_derivatives(setup, *response);
  }

  void find_derivatives(const Setup& setup, const HarmonicResponse& response) {
    const auto all = parameters();
    std::vector<std::pair<const std::pair<std::string, WantedMetric>*, std::size_t>> wanted;
    std::vector<std::size_t> columns;
    for (const auto& metric : input_.metrics) {
      const WantedMetric& m = metric.second;
      if (m.quantity.empty()) continue;
      const std::size_t column = find_column(response.columns(), m.quantity, m.origin);
      if (!has_slopes(response.columns()[column], m.response_metric())) continue;
      wanted.emplace_back(&metric, column);
      if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
    }
    if (all.empty() || wanted.empty() || !setup.built.model->traits().smooth) return;
    const Config config = with_chosen_kinematics(setup.config);
    const ResponseSensitivity sensitivity(config, setup, response, columns, all);
    for (const auto& [metric, column] : wanted) {
      const WantedMetric& m = metric->second;
      result_.derivatives.emplace_back(metric->first,
                                       metric_slopes(response, sensitivity, column, m.response_metric(), m.frequency));
    }
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
    std::vector<std::string> names;
    for (const Quantity& quantity : wanted.quantities) names.push_back(quantity.name);
    std::optional<SlopeRecorder> slopes;
    if (setup.sensitivities) observers.push_back(&slopes.emplace(setup, names));
    const Outcome outcome =
        run(*setup.built.model, *setup.integrator, setup.built.initial, plan, observers, deadline.over);
    const bool completed = conclude(outcome, setup.integrator->statistics());
    result_.cost->wall_seconds += setup.wall_seconds - mesh_error.wall_seconds;
    result_.cost->cpu_seconds += setup.cpu_seconds - mesh_error.cpu_seconds;
    if (setup.kinematics && setup.linearity) setup.linearity->finish();
    if (!completed || exceeds_allowed_error(setup)) return;
    for (std::size_t q = 0; q < wanted.metrics.size(); ++q) {
      const auto& [name, m] = *wanted.metrics[q];
      keep(name,
           m.settled_within ? settling_time(recorder.series(wanted.index[q]), *m.settled_within)
                            : metric(wanted.expectations[q], recorder, wanted.index[q]),
           m.unit_of(wanted.quantity(q).unit));
      if (slopes && m.at) result_.derivatives.emplace_back(name, slopes->at(wanted.index[q], *m.at));
    }
    keep(mesh_error);
    draw(*setup.built.model, frame.state());
  }

  std::vector<double> output_times(std::vector<Expectation> wanted, const TimeSpan& time) const {
    if (input_.frame && input_.frame_at && *input_.frame_at < time.end) wanted.emplace_back().at = input_.frame_at;
    if (input_.mesh_error)
      for (int i = 1; i <= kMeshErrorStates; ++i)
        wanted.emplace_back().at = time.start + (time.end - time.start) * i / kMeshErrorStates;
    return requested_times(wanted, time.start);
  }

  // Stores cost and failure. Returns false if the run did not complete.
  bool conclude(const Outcome& outcome, const Statistics& statistics) {
    EvaluationCost& cost = result_.cost.emplace();
    cost.cpu_seconds = given_up_.cpu_seconds + outcome.cpu_seconds;
    cost.wall_seconds = given_up_.wall_seconds + outcome.wall_seconds;
    cost.peak_memory = peak_memory();
    cost.count(statistics);
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
  double diagnostics_cpu_ = 0, diagnostics_wall_ = 0;  // s, of error estimates; not part of the cost
  EvaluationCost given_up_;  // cost of earlier attempts whose linear kinematics became invalid
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
