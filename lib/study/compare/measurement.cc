#include "lib/study/compare/measurement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "lib/simulation/error_estimate/mesh_error.h"
#include "lib/simulation/error_estimate/modal_solution.h"
#include "lib/simulation/error_estimate/recorders.h"
#include "lib/simulation/output/balance.h"
#include "lib/simulation/run/machine.h"
#include "lib/simulation/run/run.h"
#include "lib/simulation/run/several_ranks.h"
#include "lib/study/compare/frame_keeper.h"
#include "lib/study/jobs/deadline.h"
#include "lib/study/jobs/json_values.h"

namespace orthodyn::study::compare {

namespace fs = std::filesystem;

namespace {

// Allowed wall time of the observed run, in multiples of the limit for a timed run.
constexpr double kObservedTimeFactor = 3;
// Relative error above which a run counts as diverged: the error is larger than the motion.
constexpr double kDiverged = 1;
// The limit for a reference on another mesh, where opposite phase alone gives an error of 2.
constexpr double kDivergedFromAnotherMesh = 3;

// Records the change of energy at each output, J.
class EnergyRecorder : public EnergyMeter {
 public:
  using EnergyMeter::EnergyMeter;
  void on_output(const ObservedState& observed) override {
    EnergyMeter::on_output(observed);
    times.push_back(observed.t());
    changes.push_back(change());
  }
  std::vector<double> times, changes;
};

std::vector<ProbePoint> probe_points(const Setup& setup) {
  const FemModel& model = *setup.built.model;
  std::vector<ProbePoint> points;
  for (const auto& [name, probe] : setup.scene.output.probes) {
    const int node = probe.node(model.parts().mesh);
    if (model.parts().dofs->ties().is_tied(node))
      probe.origin.fail("the nearest node is tied to another surface, and has no unknowns to compare; move the probe");
    points.push_back({name, global_dofs(model, node)});
  }
  return points;
}

// True without loads, supports and mass damping: the momenta are then conserved.
bool is_free(const FemModel& model) {
  const auto& parts = model.parts();
  const bool is_loaded = parts.subdomain ? !parts.load_descriptions.empty() : !parts.loads.empty();
  return !is_loaded && parts.mass_damping == 0 &&
         model.num_dofs_of_all() == 3 * (std::ssize(parts.mesh.nodes) - std::ssize(parts.dofs->ties().nodes()));
}

// All errors equal to `e`.
TrajectoryErrors uniform_errors(double e, const std::vector<ProbePoint>& probes,
                                const std::vector<FollowedQuantity>& quantities) {
  TrajectoryErrors errors{{e, e, e}, {e, e, e}, {}, {}, e};
  for (const auto& probe : probes) errors.probes.emplace_back(probe.name, ErrorNorms{e, e, e});
  for (const auto& quantity : quantities) errors.quantities.emplace_back(quantity.name, ErrorNorms{e, e, e});
  return errors;
}

bool was_inverted(const MeasurementResult& result) { return result.smallest_det_f && *result.smallest_det_f <= 0; }

MeasurementResult result_in(const fs::path& folder) {
  const Json json = read_result(folder);
  return json.is_object() ? measurement_from(json) : MeasurementResult{};
}

// Index of the (upper) median.
std::size_t median_index(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  return order[order.size() / 2];
}

class Measurement {
 public:
  Measurement(Setup setup, const MeasurementInput& input, const fs::path& folder)
      : setup_(std::move(setup)),
        integrator_(read_scene(setup_.config).integrator),
        input_(input),
        folder_(folder),
        times_(evenly_spaced(setup_.scene.time.start, setup_.scene.time.end, input.samples)),
        quantities_(followed_quantities(setup_, input.quantities, {"quantities"})),
        frames_(folder, setup_, times_.size()) {}

  MeasurementResult result() {
    describe();
    if (const auto exact = exact_solution()) record_exact(*exact);
    else if (time_runs()) observe_run();
    return std::move(result_);
  }

 private:
  void describe() {
    const auto& model = *setup_.built.model;
    const auto& mesh = model.parts().mesh;
    const auto& time = setup_.scene.time;
    result_.model = ModelSize{static_cast<std::size_t>(model.num_dofs_of_all()),
                              mesh.cells.size(),
                              mesh.nodes.size(),
                              time.start,
                              time.end,
                              mesh.order()};
    result_.decisions = setup_.integrator->decisions();
  }

  std::optional<ModalSolution> exact_solution() const {
    if (!input_.exact_if_possible || setup_.built.model->ranks()) return std::nullopt;
    return ModalSolution::find(*setup_.built.model, setup_.built.initial);
  }

  void record_exact(const ModalSolution& exact) {
    const auto recorder = new_recorder();
    MeshErrorRecorder mesh_error(times_.size());
    const auto& model = *setup_.built.model;
    recorder->on_start({model, setup_.built.initial});
    if (keeps_frames()) frames_.on_start({model, setup_.built.initial});
    for (const double t : times_) {
      const State state = exact.at(t);
      recorder->on_output({model, state});
      if (keeps_frames()) frames_.on_output({model, state});
      if (input_.at_probes) mesh_error.on_output({model, state});
    }
    result_.kind = MeasurementResult::Kind::exact;
    result_.own_errors = uniform_errors(exact.round_off(times_.back()), probe_points(setup_), followed());
    keep(mesh_error);
    compare(recorder->trajectory());
  }

  std::unique_ptr<TrajectoryRecorder> new_recorder() const {
    if (!input_.at_probes)
      return std::make_unique<GlobalTrajectoryRecorder>(*setup_.built.model, times_.size(), quantities_);
    return std::make_unique<ProbeRecorder>(setup_.scene.output.probes, setup_.built.model->parts().mesh, times_.size(),
                                           quantities_);
  }

  ReferenceNorms norms_of(Trajectory reference) const {
    if (input_.at_probes) return probe_norms(std::move(reference), setup_.scene.output.probes, followed());
    return {*setup_.built.model, std::move(reference), probe_points(setup_), followed()};
  }

  std::vector<FollowedQuantity> followed() const {
    std::vector<FollowedQuantity> all;
    for (const auto& quantity : quantities_) all.push_back({quantity.name, quantity.components()});
    return all;
  }

  bool keeps_frames() const { return !setup_.scene.output.fields.empty(); }

  void keep(const MeshErrorRecorder& recorder) {
    if (const auto found = recorder.found()) result_.mesh_error = found->relative;
  }

  bool time_runs() {
    std::vector<double> wall, cpu;
    std::vector<Statistics> statistics;
    for (int r = 0; r < input_.repeats; ++r) {
      const auto integrator = fresh_integrator();
      const auto outcome = run_once({}, {setup_.scene.time.end, {}, false}, *integrator, input_.seconds);
      if (!outcome) return false;
      wall.push_back(outcome->wall_seconds);
      cpu.push_back(setup_.built.model->space().sum(outcome->cpu_seconds));
      statistics.push_back(integrator->statistics());
      result_.factor_bytes = integrator->factor_bytes();
    }
    if (wall.empty()) return true;
    result_.repeats = wall.size();
    result_.wall = spread(wall);
    result_.cpu = spread(cpu);
    result_.peak_memory = setup_.built.model->space().sum(peak_memory());
    result_.statistics = statistics[median_index(wall)];
    return true;
  }

  void observe_run() {
    const auto& model = *setup_.built.model;
    const auto integrator = fresh_integrator();
    const auto trajectory = new_recorder();
    MeshErrorRecorder mesh_error(times_.size());
    EnergyRecorder energy(model, *integrator);
    MomentumMeter momentum;
    InversionWatch inversion;
    std::vector<Observer*> observers{trajectory.get(), &energy, &inversion};
    if (is_free(model)) observers.push_back(&momentum);
    if (keeps_frames()) observers.push_back(&frames_);
    if (input_.keep_trajectory) observers.push_back(&mesh_error);
    const Plan plan{setup_.scene.time.end, times_, false};
    const auto outcome = run_once(observers, plan, *integrator, kObservedTimeFactor * input_.seconds);
    if (!outcome) return;
    result_.kind = MeasurementResult::Kind::computed;
    if (!result_.wall) result_.statistics = integrator->statistics(), result_.seconds = outcome->wall_seconds;
    result_.drift = drift_of(energy, momentum);
    result_.drift_over_time = EnergyChange{energy.times, {}};
    for (const double change : energy.changes)
      result_.drift_over_time->changes.push_back(energy.scale() > 0 ? change / energy.scale() : 0);
    result_.smallest_det_f = inversion.smallest();
    keep(mesh_error);
    compare(trajectory->trajectory());
  }

  // Empty if the run failed; the failure is then stored in the result.
  std::optional<Outcome> run_once(std::vector<Observer*> observers, const Plan& plan, Integrator& integrator,
                                  double seconds) {
    Deadline deadline(seconds);
    observers.push_back(&deadline);
    Outcome outcome = run(*setup_.built.model, integrator, setup_.built.initial, plan, observers, deadline.over);
    require_failure_of_all(setup_.built.model->ranks(), outcome);
    result_.time_reached = outcome.last.t;
    if (outcome.status == Outcome::Status::completed) return outcome;
    result_.failure = failure_of(outcome, seconds);
    result_.statistics = integrator.statistics();
    return std::nullopt;
  }

  // Reuses the decisions of the set-up: scales are not estimated again.
  std::unique_ptr<Integrator> fresh_integrator() const {
    Task task = task_of(setup_.scene, setup_.built);
    task.scales = []() -> Scales { throw std::logic_error("scales are known"); };
    return integrator_->make(*setup_.built.model, task);
  }

  Drift drift_of(const EnergyMeter& energy, const MomentumMeter& momentum) const {
    const auto& parts = setup_.built.model->parts();
    const bool is_kept = is_free(*setup_.built.model);
    const auto relative = [&](double drift, double scale) {
      return is_kept && scale > 0 ? drift / scale : std::numeric_limits<double>::quiet_NaN();
    };
    // Scales of the momenta: those of the whole mass m with the largest energy E as kinetic energy, sqrt(2 m E). The
    // body's own momenta may be zero.
    const double linear = std::sqrt(2 * parts.mass->total() * energy.scale());
    const double angular = linear * bounding_box(parts.mesh).diagonal() / 2;
    return {energy.relative_drift(), relative(momentum.linear_drift(), linear),
            relative(momentum.angular_drift(), angular)};
  }

  void compare(const Trajectory& trajectory) {
    if (input_.keep_trajectory) {
      trajectory.save(folder_ / kTrajectoryFile);
      result_.scales = norms_of(trajectory).scales();
    }
    if (input_.reference.empty()) return;
    const fs::path folder = input_.reference;
    const ReferenceNorms reference = norms_of(Trajectory::load(folder / kTrajectoryFile));
    result_.errors = reference.errors(trajectory);
    const bool nothing_moves = reference.scales().displacement == 0;
    const double most = input_.at_probes ? kDivergedFromAnotherMesh : kDiverged;
    if (!(result_.errors->displacement.max <= most) && !nothing_moves)
      result_.failure = Failure{"diverged", "the error is larger than the motion"};
    else if (was_inverted(result_) && !was_inverted(result_in(folder)))
      result_.failure = Failure{"inverted", "an element was inverted; none is inverted in the reference"};
  }

  Setup setup_;
  std::shared_ptr<const IntegratorChoice> integrator_;
  const MeasurementInput& input_;
  const fs::path& folder_;
  std::vector<double> times_;
  std::vector<Quantity> quantities_;
  FrameKeeper frames_;
  MeasurementResult result_;
};

}  // namespace

std::vector<Quantity> followed_quantities(const Setup& setup, const std::vector<std::string>& names,
                                          const SourceLocation& origin) {
  std::vector<Quantity> all;
  for (const auto& name : names) {
    all.push_back(find_quantity(name, setup.scene, *setup.built.model, origin));
    if (!all.back().values)
      origin.fail("'" + name +
                  "' cannot be compared with a reference; the energy drift is measured for every point anyway");
    if (all.back().components() > 1 && !all.back().is_vector()) origin.fail(all.back().ask_for_component());
  }
  return all;
}

MeasurementResult measure(Setup setup, const MeasurementInput& input, const fs::path& folder) {
  return Measurement(std::move(setup), input, folder).result();
}

void measure(const fs::path& folder, const Ranks* ranks) {
  serve_job(
      folder,
      [&](const Json& input) {
        const Config scene = Config::from_file((folder / kSceneFile).string());
        return to_json(measure(set_up(scene, false, true, ranks), measurement_input_from(input), folder));
      },
      ranks);
}

}  // namespace orthodyn::study::compare
