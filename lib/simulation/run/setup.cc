#include "lib/simulation/run/setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "lib/analysis/scales.h"
#include "lib/analysis/strain_check.h"
#include "lib/core/limit_error.h"
#include "lib/core/spelling.h"
#include "lib/linear/blas.h"
#include "lib/scene/events.h"
#include "lib/scene/quantity.h"
#include "lib/simulation/harmonic/response_columns.h"
#include "lib/simulation/output/extremes.h"
#include "lib/simulation/preflight/input_checks/input_checks.h"
#include "lib/simulation/run/outcome.h"
#include "lib/simulation/run/several_ranks.h"
#include "lib/simulation/statics/static_problem.h"

namespace orthodyn {

namespace {

void append(Warnings more, Warnings& all) {
  for (auto& warning : more) all.push_back(std::move(warning));
}

// Throws unless each of `fields` is an output of the model at one of the allowed locations.
void check_fields(const Model& model, const std::vector<std::string>& fields, std::vector<Location> allowed,
                  const SourceLocation& origin) {
  std::vector<std::string> names, short_names;
  for (const auto& info : model.outputs()) {
    if (std::find(allowed.begin(), allowed.end(), info.location) == allowed.end()) continue;
    names.push_back(info.name);
    if (info.name.find('.') == std::string::npos) short_names.push_back(info.name);
  }
  for (const auto& field : fields) {
    if (std::find(names.begin(), names.end(), field) != names.end()) continue;
    origin.fail(fmt::format("unknown field '{}'{}; known: {}; stress and strain fields also as REGION.FIELD", field,
                            did_you_mean(field, names), join(short_names)));
  }
}

void check_outputs(const Scene& scene, const FemModel& model) {
  for (const auto& [name, gauge] : scene.output.gauges) PlacedGauge(gauge, model.parts().mesh);  // throws
  if (scene.harmonic) {
    response_columns(scene, model);  // throws for an unknown field
    return;
  }
  const FrameFields& fields = scene.output.fields;
  check_fields(model, fields, {Location::node, Location::cell}, fields.origin);
  for (const auto& field : fields) require_strengths(field, "", model, fields.origin);
  for (const auto& [name, probe] : scene.output.probes) {
    check_fields(model, probe.fields, {Location::node}, probe.origin);
    for (const auto& field : probe.fields) require_field_at(field, probe.node(model.parts().mesh), model, probe.origin);
  }
  ExtremeRecorder(scene, model);  // throws for an unknown quantity
}

void check_expectations(const Scene& scene, const FemModel& model) {
  for (const auto& e : scene.expect) {
    if (e.is_eigenvalue()) {
      e.require_units(e.mode ? "Hz" : "");
      continue;
    }
    if (scene.harmonic) {
      const auto columns = response_columns(scene, model);
      e.require_response_units(columns[find_column(columns, e.quantity, e.origin)].unit);
      continue;
    }
    const Quantity quantity = find_quantity(e.quantity, scene, model, e.origin);
    if (quantity.components() > 1 && !(quantity.is_vector() && !e.at && e.take == TimeReduction::drift))
      e.origin.fail(quantity.ask_for_component());
    e.require_units(quantity.unit);
    if (scene.is_static() && (e.at || e.take != TimeReduction::end || !quantity.values))
      e.origin.fail("a static analysis gives values in equilibrium only: remove 'take' and 'at'" +
                    std::string(quantity.values ? "" : ", choose another quantity than energy.balance"));
    if (e.at && (*e.at < scene.time.start || *e.at > scene.time.end))
      e.origin.fail(fmt::format("at: {} s is outside of the time span", *e.at));
  }
}

std::unique_ptr<Integrator> make_integrator(Config& config, const Scene& scene, const Task& task, const Model& model) {
  std::unique_ptr<Integrator> integrator;
  try {
    integrator = scene.integrator->make(model, task);
  } catch (const ConfigError& e) {
    if (!e.place().empty()) throw;  // names its input already, as for a formula without a value
    config.at("integrator").fail(e.message());
  }
  const Config section = config.at("integrator");
  for (const auto& [key, value] : integrator->decisions())
    if (!section.has(key)) section.fill(key, value);
  return integrator;
}

void start_from_equilibrium(const Scene& scene, BuiltScene& built) {
  try {
    built.initial = initial_state_at(equilibrium(scene, built), scene.initial, scene.time.start, *built.model);
  } catch (const RunError& e) {
    throw RunError(std::string("start: equilibrium: ") + e.what(), e.reason());
  }
}

// Throws ConfigError if the force at the start cannot be evaluated. Checked here, where the message can name the input.
void require_force_at_start(const Config& config, const BuiltScene& built) {
  const State& start = built.initial;
  Vector force(start.q.size());
  std::string reason = "it is not finite";
  try {
    built.model->force(start.t, start.q, start.v, force);
    if (built.model->space().is_finite(force)) return;
  } catch (const LimitError& e) {
    throw ConfigError(e.place(), e.message());
  } catch (const RecoverableError& e) {
    reason = e.what();
  }
  config.at(config.has("initial") ? "initial" : "mesh")
      .fail(fmt::format(
          "the force at the start cannot be evaluated: {}; check the initial state, the loads and the unit of length",
          reason));
}

}  // namespace

void Setup::note_kinematics_restart(const std::string& reason) {
  if (!kinematics) kinematics.emplace();
  kinematics->add_reason(reason);
}

Task task_of(const Scene& scene, const BuiltScene& built) {
  const auto& [start, end] = scene.time;
  const double frames = scene.output.frames.value_or(50);
  const double interval = scene.output.interval.value_or((end - start) / std::max(frames, 1.0));
  const auto scales = [&built, start = start, end = end] {
    return estimate_scales(*built.model, built.initial, end, static_response(*built.model, built.initial, end));
  };
  return {scales, built.initial, end, interval};
}

namespace {

Setup set_up(Config config, Scene scene, bool resumes_linear, bool is_timed, const Ranks* ranks) {
  if (ranks) adapt_to_ranks(config, scene);
  std::optional<KinematicsChoice> kinematics;
  std::unique_ptr<LinearityWatch> linearity;
  const auto build_it = [&] {
    if (!leaves_kinematics_open(scene)) return build(scene, ranks);
    ChosenKinematics chosen = choose_kinematics(config, scene, resumes_linear);
    kinematics = std::move(chosen.choice);
    linearity = std::move(chosen.watch);
    return std::move(chosen.built);
  };
  BuiltScene built = build_it();
  if (!linearity && !ranks) linearity = reporting_watch(scene, *built.model);
  if (!scene.is_static()) require_force_at_start(config, built);
  check_outputs(scene, *built.model);
  check_expectations(scene, *built.model);
  append(config.warnings(), built.warnings);
  if (!ranks) append(check_inputs(config, scene, built, is_timed), built.warnings);
  std::optional<StaticResponse> statics;  // computed on first use
  const auto response = [&]() -> const StaticResponse& {
    if (!statics) statics = static_response(*built.model, built.initial, scene.time.end);
    return *statics;
  };
  if (!ranks && built.model->num_dofs() <= kMaxUnknownsOfResponse)
    append(check_response(config, scene, built, response()), built.warnings);
  if (!ranks && !built.model->traits().linear && needs_strain_check(*built.model))
    append(strain_warnings(*built.model, built.initial, response()), built.warnings);
  std::vector<Event> events = make_events(scene, *built.model);
  if (ranks && !scene.sensitivities.empty())
    scene.sensitivities.origin.fail("are computed by one process: remove --ranks");
  if (scene.is_static()) model_parameters(config, scene.sensitivities, scene.sensitivities.origin);  // throws
  std::unique_ptr<MotionSensitivity> sensitivities;
  std::unique_ptr<Integrator> integrator;
  double wall = 0, cpu = 0;
  if (!scene.is_static()) {
    if (scene.start == Start::equilibrium) {
      start_from_equilibrium(scene, built);
      statics.reset();  // the initial state has changed
    }
    Task task = task_of(scene, built);
    task.scales = [&] { return estimate_scales(*built.model, built.initial, scene.time.end, response()); };
    const auto begin = std::chrono::steady_clock::now();
    const double begin_cpu = cpu_seconds_now();
    if (!scene.sensitivities.empty()) {
      sensitivities = std::make_unique<MotionSensitivity>(with_chosen_kinematics(config), scene, built,
                                                          scene.sensitivities, scene.sensitivities.origin);
      task.sensitivities = sensitivities.get();
      if (scene.output.reactions)
        built.warnings.push_back(scene.sensitivities.origin.where +
                                 ": derivatives of reactions contain accelerations of stiff modes and are far less "
                                 "accurate than rtol; compare "
                                 "them with those of a run with a smaller integrator.rtol");
    }
    integrator = make_integrator(config, scene, task, *built.model);
    wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    cpu = cpu_seconds_now() - begin_cpu;
    const bool is_checked = ranks || built.model->num_dofs() <= kMaxUnknownsOfResponse;
    if (statics && !is_checked && scene.start == Start::rest)
      append(check_response(config, scene, built, *statics), built.warnings);
  }
  if (ranks && has_linear_region(scene))
    built.warnings.push_back(
        "several ranks do not estimate the error of linear kinematics; run on one process to see it");
  if (!blas_is_openblas())
    built.warnings.push_back(
        "the BLAS in use is not OpenBLAS; large factorisations will be several times slower (Debian: "
        "libopenblas0-pthread)");
  return {std::move(config),
          std::move(scene),
          std::move(built),
          std::move(sensitivities),
          std::move(integrator),
          std::move(events),
          std::move(kinematics),
          std::move(linearity),
          wall,
          cpu};
}

}  // namespace

Setup set_up(const Config& input, bool resumes_linear, bool is_timed, const Ranks* ranks) {
  const Config config = input.resolving();
  const Scene scene = read_scene(config);
  return scene.places.with([&] { return set_up(config, scene, resumes_linear, is_timed, ranks); });
}

}  // namespace orthodyn
