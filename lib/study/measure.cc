#include "lib/study/measure.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "lib/run/balance.h"
#include "lib/run/files.h"
#include "lib/run/run.h"
#include "lib/scene/setup.h"
#include "lib/study/modal_solution.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// A run that is watched may take this much longer than a timed one.
constexpr double kPatience = 3;
// More of the motion than there is: the trajectory has nothing to do with the reference.
constexpr double kDiverged = 1;

// Ends a run that takes too long, after the step in progress.
class Deadline : public Observer {
 public:
  explicit Deadline(double seconds) : end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                              std::chrono::duration<double>(seconds))) {}
  void on_step(const StepInfo&, const State&, const Integrator&) override {
    if (Clock::now() > end_) over = true;
  }
  std::atomic<bool> over{false};

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point end_;
};

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

class Measurement {
 public:
  Measurement(Setup setup, const Job& job, const fs::path& folder)
      : setup_(std::move(setup)), integrator_(read_scene(setup_.config).integrator), job_(job), folder_(folder),
        times_(evenly_spaced(setup_.scene.time.start, setup_.scene.time.end, job.samples)) {}

  Json result() {
    describe_model();
    if (!(job_.exact_if_possible && take_exact_solution()) && time_runs()) watch_run();
    return std::move(result_);
  }

 private:
  void describe_model() {
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

  bool take_exact_solution() {
    const auto exact = ModalSolution::find(*setup_.built.model, setup_.built.initial);
    if (!exact) return false;
    TrajectoryRecorder recorder(times_.size());
    recorder.on_start(setup_.built.initial);
    for (const double t : times_) recorder.on_output(exact->at(t));
    result_["kind"] = "exact";
    compare(recorder.trajectory());
    return true;
  }

  // A run of a fresh integrator; false if it did not complete, which is then in the result.
  bool run_once(const std::vector<Observer*>& observers, const Plan& plan, Integrator& integrator, double seconds,
                Outcome& outcome) {
    Deadline deadline(seconds);
    std::vector<Observer*> all = observers;
    all.push_back(&deadline);
    outcome = run(*setup_.built.model, integrator, setup_.built.initial, plan, all, deadline.over);
    result_["time_reached"] = outcome.last.t;
    if (outcome.status == Outcome::Status::completed) return true;
    result_["status"] = "failed";
    const bool late = outcome.status == Outcome::Status::interrupted;
    result_["reason"] = late ? "time limit" : reason_name(outcome.reason);
    result_["message"] = late ? "not done after the limit of the wall time" : outcome.message;
    result_["statistics"] = to_json(integrator.statistics());
    return false;
  }

  std::unique_ptr<Integrator> fresh_integrator() const {
    return integrator_->make(*setup_.built.model, []() -> Scales { throw std::logic_error("scales are known"); });
  }

  bool time_runs() {
    std::vector<double> wall, cpu;
    std::vector<Json> statistics;
    for (int r = 0; r < job_.repeats; ++r) {
      const auto integrator = fresh_integrator();
      Outcome outcome;
      if (!run_once({}, {setup_.scene.time.end, {}, false}, *integrator, job_.seconds, outcome)) return false;
      wall.push_back(outcome.wall_seconds);
      cpu.push_back(outcome.cpu_seconds);
      statistics.push_back(to_json(integrator->statistics()));
      result_["factor_bytes"] = integrator->factor_bytes();
    }
    if (wall.empty()) return true;
    result_["repeats"] = wall.size();
    result_["wall"] = spread(wall);
    result_["cpu"] = spread(cpu);
    std::vector<std::size_t> order(wall.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return wall[a] < wall[b]; });
    result_["statistics"] = statistics[order[order.size() / 2]];
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    result_["peak_memory_bytes"] = usage.ru_maxrss * 1024;
    return true;
  }

  void watch_run() {
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
    if (job_.repeats == 0) {
      result_["statistics"] = to_json(integrator->statistics());
      result_["seconds"] = outcome.wall_seconds;
    }
    record_drift(energy, momentum);
    result_["smallest_det_f"] = inversion.smallest();
    compare(trajectory.trajectory());
  }

  void record_drift(const EnergyCourse& energy, const MomentumMeter& momentum) {
    const bool is_free_body = is_free(*setup_.built.model);
    const auto relative = [&](double drift, double scale) { return is_free_body && scale > 0 ? Json(drift / scale) : Json(); };
    result_["drift"] = {{"energy", energy.relative_drift()},
                        {"linear_momentum", relative(momentum.linear_drift(), momentum.linear_scale())},
                        {"angular_momentum", relative(momentum.angular_drift(), momentum.angular_scale())}};
    std::vector<double> relative_changes;
    for (const double change : energy.changes)
      relative_changes.push_back(energy.scale() > 0 ? change / energy.scale() : 0);
    result_["drift_over_time"] = {{"t", energy.times}, {"energy", relative_changes}};
  }

  void compare(const Trajectory& trajectory) {
    if (job_.keep_trajectory) trajectory.save(folder_ / kTrajectoryFile);
    if (job_.reference.empty()) {
      if (job_.keep_trajectory)
        result_["scales"] = to_json(ReferenceNorms(*setup_.built.model, trajectory, probe_points(setup_)).scales());
      return;
    }
    const ReferenceNorms reference(*setup_.built.model, Trajectory::load(fs::path(job_.reference) / kTrajectoryFile),
                                   probe_points(setup_));
    const auto errors = reference.errors(trajectory);
    result_["errors"] = to_json(errors);
    if (errors.displacement.max <= kDiverged) return;
    result_["status"] = "failed";
    result_["reason"] = "diverged";
    result_["message"] = "the error is larger than the motion";
  }

  Setup setup_;
  std::shared_ptr<const IntegratorChoice> integrator_;  // with what the set-up decided: nothing is estimated again
  Job job_;
  fs::path folder_;
  std::vector<double> times_;
  Json result_;
};

Json failure(const std::string& reason, const std::string& message) {
  return {{"status", "failed"}, {"reason", reason}, {"message", message}};
}

Json measured(const fs::path& folder) {
  std::ifstream in(folder / kJobFile);
  const Job job = Job::from(Json::parse(in));
  try {
    return Measurement(set_up(Config::from_file((folder / kSceneFile).string())), job, folder).result();
  } catch (const ConfigError& e) {
    return failure("refused", e.what());
  } catch (const std::bad_alloc&) {
    return failure("memory limit", "out of memory");
  }
}

}  // namespace

void measure(const fs::path& folder) { write_file(folder / kResultFile, {measured(folder).dump() + "\n"}); }

}  // namespace orthodyn
