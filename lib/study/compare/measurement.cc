#include "lib/study/compare/measurement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "lib/study/jobs/deadline.h"
#include "lib/simulation/machine.h"
#include "lib/study/compare/measure.h"
#include "lib/simulation/errors/modal_solution.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// A run that is watched may take this much longer than a timed one.
constexpr double kPatience = 3;
// More of the motion than there is: the trajectory has nothing to do with the reference.
constexpr double kDiverged = 1;

// The energy's change at each output, relative to nothing yet.
class EnergyCourse : public EnergyMeter {
 public:
  using EnergyMeter::EnergyMeter;
  void on_output(const State& state) override {
    EnergyMeter::on_output(state);
    times.push_back(state.t);
    changes.push_back(change());
  }
  std::vector<double> times, changes;
};

std::vector<ProbePoint> probe_points(const Setup& setup) {
  const auto& parts = setup.built.model->parts();
  std::vector<ProbePoint> points;
  for (const auto& [name, probe] : setup.scene.output.probes)
    points.push_back({name, parts.dofs->node(nearest_node(parts.mesh, probe.at))});
  return points;
}

// Nothing acts on the body from outside: its momenta are constant.
bool is_free(const FemModel& model) {
  const auto& parts = model.parts();
  return parts.loads.empty() && parts.mass_damping == 0 &&
         model.num_dofs() == 3 * static_cast<int>(parts.mesh.nodes.size());
}

// The same error in every measure.
TrajectoryErrors uniform_errors(double e, const std::vector<ProbePoint>& probes) {
  TrajectoryErrors errors{{e, e, e}, {e, e, e}, {}, e};
  for (const auto& probe : probes) errors.probes.emplace_back(probe.name, ErrorNorms{e, e, e});
  return errors;
}

// The smallest det F of a result; infinite where it has none.
double smallest_det_f(const Json& result) {
  const bool known = result.is_object() && result.contains("smallest_det_f") && result.at("smallest_det_f").is_number();
  return known ? result.at("smallest_det_f").get<double>() : std::numeric_limits<double>::infinity();
}

// The index of the median.
std::size_t middle(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  return order[order.size() / 2];
}

}  // namespace

Measurement::Measurement(Setup setup, const Job& job, fs::path folder)
    : setup_(std::move(setup)), integrator_(read_scene(setup_.config).integrator), job_(job),
      folder_(std::move(folder)), times_(evenly_spaced(setup_.scene.time.start, setup_.scene.time.end, job.samples)) {}

Json Measurement::result() {
  describe_model();
  if (!(job_.exact_if_possible && take_exact_solution()) && time_runs()) watch_run();
  return std::move(result_);
}

void Measurement::describe_model() {
  const auto& model = *setup_.built.model;
  const auto& time = setup_.scene.time;
  result_["status"] = "completed";
  result_["model"] = {{"unknowns", model.num_dofs()},
                      {"elements", model.parts().mesh.tets.size()},
                      {"nodes", model.parts().mesh.nodes.size()},
                      {"start", time.start},
                      {"end", time.end}};
  Json decisions = Json::object();
  for (const auto& [key, value] : setup_.integrator->decisions()) decisions[key] = value;
  result_["decisions"] = decisions;
}

bool Measurement::take_exact_solution() {
  const auto exact = ModalSolution::find(*setup_.built.model, setup_.built.initial);
  if (!exact) return false;
  TrajectoryRecorder recorder(times_.size());
  recorder.on_start(setup_.built.initial);
  for (const double t : times_) recorder.on_output(exact->at(t));
  result_["kind"] = "exact";
  result_["own_errors"] = to_json(uniform_errors(exact->round_off(times_.back()), probe_points(setup_)));
  compare(recorder.trajectory());
  return true;
}

// False if the run did not complete, which is then in the result.
bool Measurement::run_once(const std::vector<Observer*>& observers, const Plan& plan, Integrator& integrator,
                           double seconds, Outcome& outcome) {
  Deadline deadline(seconds);
  std::vector<Observer*> all = observers;
  all.push_back(&deadline);
  outcome = run(*setup_.built.model, integrator, setup_.built.initial, plan, all, deadline.over);
  result_["time_reached"] = outcome.last.t;
  if (outcome.status == Outcome::Status::completed) return true;
  if (outcome.status == Outcome::Status::interrupted) fail(kTimeLimit, too_late(seconds, outcome.last.t));
  else fail(reason_name(outcome.reason), outcome.message);
  result_["statistics"] = to_json(integrator.statistics());
  return false;
}

std::unique_ptr<Integrator> Measurement::fresh_integrator() const {
  Task task = task_of(setup_.scene, setup_.built);
  task.scales = []() -> Scales { throw std::logic_error("scales are known"); };
  return integrator_->make(*setup_.built.model, task);
}

bool Measurement::time_runs() {
  std::vector<double> wall, cpu;
  std::vector<Statistics> statistics;
  for (int r = 0; r < job_.repeats; ++r) {
    const auto integrator = fresh_integrator();
    Outcome outcome;
    if (!run_once({}, {setup_.scene.time.end, {}, false}, *integrator, job_.seconds, outcome)) return false;
    wall.push_back(outcome.wall_seconds);
    cpu.push_back(outcome.cpu_seconds);
    statistics.push_back(integrator->statistics());
    result_["factor_bytes"] = integrator->factor_bytes();
  }
  if (!wall.empty()) record_timing(wall, cpu, statistics);
  return true;
}

void Measurement::record_timing(const std::vector<double>& wall, const std::vector<double>& cpu,
                                const std::vector<Statistics>& statistics) {
  result_["repeats"] = wall.size();
  result_["wall"] = spread(wall);
  result_["cpu"] = spread(cpu);
  result_["statistics"] = to_json(statistics[middle(wall)]);
  result_["peak_memory_bytes"] = peak_memory();
}

void Measurement::watch_run() {
  const auto& model = *setup_.built.model;
  const auto integrator = fresh_integrator();
  TrajectoryRecorder trajectory(times_.size());
  EnergyCourse energy(model, *integrator);
  MomentumMeter momentum(model);
  InversionWatch inversion(model);
  std::vector<Observer*> observers{&trajectory, &energy, &inversion};
  if (is_free(model)) observers.push_back(&momentum);
  Outcome outcome;
  const Plan plan{setup_.scene.time.end, times_, false};
  if (!run_once(observers, plan, *integrator, kPatience * job_.seconds, outcome)) return;
  result_["kind"] = "computed";
  if (job_.repeats == 0) {  // nothing was timed: it is a reference
    result_["statistics"] = to_json(integrator->statistics());
    result_["seconds"] = outcome.wall_seconds;
  }
  record_drift(energy, momentum);
  std::vector<double> changes;
  for (const double change : energy.changes) changes.push_back(energy.scale() > 0 ? change / energy.scale() : 0);
  result_["drift_over_time"] = {{"t", energy.times}, {"energy", changes}};
  result_["smallest_det_f"] = inversion.smallest();
  compare(trajectory.trajectory());
}

void Measurement::record_drift(const EnergyMeter& energy, const MomentumMeter& momentum) {
  const auto& parts = setup_.built.model->parts();
  const bool is_kept = is_free(*setup_.built.model);
  const auto relative = [&](double drift, double scale) { return is_kept && scale > 0 ? Json(drift / scale) : Json(); };
  // What momentum the largest energy could be: a body at rest has none of its own to compare with.
  const double linear = std::sqrt(2 * parts.mass->total() * energy.scale());
  const double angular = linear * bounding_box(parts.mesh).diagonal() / 2;
  result_["drift"] = {{"energy", energy.relative_drift()},
                      {"linear_momentum", relative(momentum.linear_drift(), linear)},
                      {"angular_momentum", relative(momentum.angular_drift(), angular)}};
}

void Measurement::compare(const Trajectory& trajectory) {
  const auto& model = *setup_.built.model;
  if (job_.keep_trajectory) {
    trajectory.save(folder_ / kTrajectoryFile);
    result_["scales"] = to_json(ReferenceNorms(model, trajectory, probe_points(setup_)).scales());
  }
  if (job_.reference.empty()) return;
  const ReferenceNorms reference(model, Trajectory::load(fs::path(job_.reference) / kTrajectoryFile),
                                 probe_points(setup_));
  const auto errors = reference.errors(trajectory);
  result_["errors"] = to_json(errors);
  const bool nothing_moves = reference.scales().displacement == 0;
  if (!(errors.displacement.max <= kDiverged) && !nothing_moves)
    fail("diverged", "the error is larger than the motion");
  else if (smallest_det_f(result_) <= 0 && smallest_det_f(read_json(fs::path(job_.reference) / kResultFile)) > 0)
    fail("inverted", "an element was inverted, which does not happen in the reference");
}

void Measurement::fail(const std::string& reason, const std::string& message) {
  result_["status"] = "failed";
  result_["reason"] = reason;
  result_["message"] = message;
}

}  // namespace orthodyn
