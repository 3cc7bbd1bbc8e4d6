#include "lib/study/sweep/evaluate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>

#include "lib/simulation/run.h"
#include "lib/simulation/equilibrium.h"
#include "lib/simulation/frames.h"
#include "lib/simulation/load_steps.h"
#include "lib/simulation/setup.h"
#include "lib/study/jobs/deadline.h"
#include "lib/study/quantities/figure.h"
#include "lib/simulation/fingerprints.h"
#include "lib/simulation/machine.h"
#include "lib/study/compare/measure.h"
#include "lib/simulation/errors/snapshot.h"
#include "lib/study/quantities/wanted_modes.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

Json cost_json(const Outcome& outcome, const Statistics& s) {
  return {{"cpu_seconds", outcome.cpu_seconds}, {"wall_seconds", outcome.wall_seconds},
          {"steps", s.steps},                   {"rejected_steps", s.rejected_steps},
          {"newton_iterations", s.newton_iterations}, {"forces", s.force.count},
          {"tangents", s.tangent.count},        {"factorizations", s.factorization.count},
          {"solves", s.solve.count},            {"peak_memory", peak_memory()}};
}

class Evaluation {
 public:
  Evaluation(const Config& scene, const PointJob& job, const fs::path& folder)
      : config_(scene), job_(job), folder_(folder) {
    result_ = {{"status", "completed"}, {"figures", Json::object()}, {"units", Json::object()}, {"cost", nullptr}};
  }

  Json result() {
    if (wants([](const WantedFigure& f) { return !f.is_of_motion(); })) find_modes();
    if (job_.frame || wants([](const WantedFigure& f) { return f.is_of_motion(); })) follow_motion();
    return std::move(result_);
  }

 private:
  template <class Condition>
  bool wants(const Condition& condition) const {
    return std::any_of(job_.figures.begin(), job_.figures.end(), [&](const auto& f) { return condition(f.second); });
  }

  void keep(const std::string& name, double value, const std::string& unit) {
    result_["figures"][name] = finite_or_null(value);
    result_["units"][name] = unit;
  }

  void describe(const FemModel& model) {
    result_["model"] = {{"unknowns", model.num_dofs()}, {"elements", model.parts().mesh.tets.size()}};
  }

  // Modes: nothing of the scene's integrator is set up.
  void find_modes() {
    const auto started = std::chrono::steady_clock::now();
    const double cpu = cpu_seconds_now();
    const Scene scene = read_scene(config_);
    const Scene still = scene.analysis == Analysis::dynamic ? at_rest(scene) : scene;
    const BuiltScene built = build(still);
    describe(*built.model);
    for (const bool about_equilibrium : {false, true}) {
      const Vector zero = Vector::Zero(built.model->num_dofs());
      const auto concerns = [&](const WantedFigure& f) {
        return !f.is_of_motion() && f.about_equilibrium == about_equilibrium;
      };
      if (!wants(concerns)) continue;
      const State about{still.time.end, about_equilibrium ? equilibrium(still, built) : zero, zero};
      std::vector<std::string> names;
      std::vector<WantedFigure> wanted;
      for (const auto& [name, f] : job_.figures)
        if (concerns(f)) names.push_back(name), wanted.push_back(f);
      const auto frequencies = wanted_frequencies(wanted, *built.model, about);
      for (std::size_t k = 0; k < names.size(); ++k) keep(names[k], frequencies[k], wanted[k].unit_of(""));
    }
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - started;
    result_["cost"] = {{"cpu_seconds", cpu_seconds_now() - cpu}, {"wall_seconds", wall.count()},
                       {"peak_memory", peak_memory()}};
  }

  void follow_motion() {
    Setup setup = set_up(config_);
    const FemModel& model = *setup.built.model;
    describe(model);
    std::vector<std::string> names;
    std::vector<Expectation> wanted;
    std::vector<Quantity> quantities;
    for (const auto& [name, f] : job_.figures) {
      if (f.quantity.empty()) continue;
      names.push_back(name);
      Expectation& e = wanted.emplace_back();
      e.quantity = f.quantity, e.take = f.take, e.at = f.at, e.of = f.of;
      quantities.push_back(find_quantity(f.quantity, setup.scene, model, f.origin));
    }
    if (setup.scene.analysis == Analysis::statical) find_equilibrium(setup, names, quantities);
    else integrate(setup, names, wanted, quantities);
    if (result_.at("status") != "completed") return;
    for (const auto& [name, f] : job_.figures)
      if (!f.cost.empty()) keep(name, result_.at("cost").at(f.cost).get<double>(), f.unit_of(""));
  }

  void find_equilibrium(const Setup& setup, const std::vector<std::string>& names,
                        const std::vector<Quantity>& quantities) {
    const StaticProblem problem = static_problem(setup.scene, setup.built);
    Deadline deadline(job_.seconds);
    const Outcome outcome = run_static(*problem.stepper, {&deadline}, deadline.over);
    Statistics statistics = problem.solver->statistics();
    statistics.steps = problem.stepper->steps();
    statistics.rejected_steps = problem.stepper->rejected();
    if (!conclude(outcome, statistics)) return;
    const State state{problem.path->time(), outcome.last.q, outcome.last.v};
    for (std::size_t q = 0; q < names.size(); ++q) keep(names[q], quantities[q].values(state)[0], quantities[q].unit);
    draw(*setup.built.model, state);
  }

  void integrate(Setup& setup, const std::vector<std::string>& names, const std::vector<Expectation>& wanted,
                 const std::vector<Quantity>& quantities) {
    SeriesRecorder recorder(*setup.built.model, *setup.integrator, quantities);
    Deadline deadline(job_.seconds);
    Snapshot frame(job_.frame_at);
    Plan plan{setup.scene.time.end, output_times(wanted, setup.scene.time), false};
    EventFinder events(setup.events);
    if (!events.empty()) plan.events = &events;
    const Outcome outcome = run(*setup.built.model, *setup.integrator, setup.built.initial, plan,
                                {&recorder, &deadline, &frame}, deadline.over);
    if (!conclude(outcome, setup.integrator->statistics())) return;
    for (std::size_t q = 0; q < names.size(); ++q) {
      const WantedFigure& f = figure_named(names[q]);
      keep(names[q],
           f.settled_within ? settling_time(recorder.series(q), *f.settled_within) : figure(wanted[q], recorder, q),
           f.unit_of(quantities[q].unit));
    }
    draw(*setup.built.model, frame.state());
  }

  std::vector<double> output_times(std::vector<Expectation> wanted, const TimeSpan& time) const {
    if (job_.frame && job_.frame_at && *job_.frame_at < time.end) wanted.emplace_back().at = job_.frame_at;
    return times_asked_for(wanted, time.start);
  }

  const WantedFigure& figure_named(const std::string& name) const {
    return std::find_if(job_.figures.begin(), job_.figures.end(), [&](const auto& f) { return f.first == name; })
        ->second;
  }

  // False if it did not get to its end, which is then the result.
  bool conclude(const Outcome& outcome, const Statistics& statistics) {
    result_["cost"] = cost_json(outcome, statistics);
    if (outcome.status == Outcome::Status::completed) return true;
    const bool late = outcome.status == Outcome::Status::interrupted;
    result_["status"] = "failed";
    result_["reason"] = late ? kTimeLimit : reason_name(outcome.reason);
    result_["message"] = late ? too_late(job_.seconds, outcome.last.t) : outcome.message;
    return false;
  }

  void draw(const FemModel& model, const State& state) {
    if (!job_.frame) return;
    std::vector<VtuField> fields;
    for (const auto& info : model.outputs())
      if (info.location != Location::global && (info.name == "displacement" || info.name == *job_.frame))
        fields.push_back({info.name, info.location, info.components, model.evaluate(info.name, state)});
    write_vtu(folder_ / kFrameFile, model.geometry(), fields);
    result_["frame"] = kFrameFile;
  }

  const Config& config_;
  const PointJob& job_;
  const fs::path& folder_;
  Json result_;
};

}  // namespace

Json evaluate(const Config& scene, const PointJob& job, const fs::path& folder) {
  return Evaluation(scene, job, folder).result();
}

void evaluate(const fs::path& folder) {
  do_job(folder, [&](const Json& job) {
    return evaluate(Config::from_file((folder / kSceneFile).string()), PointJob::from(job), folder);
  });
}

}  // namespace orthodyn
