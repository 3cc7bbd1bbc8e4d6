// Computes the data of a fit by jobs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/errors.h"
#include "lib/scene/scene.h"
#include "lib/simulation/run/fingerprints.h"
#include "lib/study/fit/problem.h"
#include "lib/study/fit/readings.h"
#include "lib/study/inputs/refined_mesh.h"

namespace orthodyn::study::fit {

namespace {

// Steps of differences between runs, in the coordinates z: 0.2 %, and 0.5 % of a ratio's interval.
constexpr double kLogStep = 0.002, kRatioStep = 0.02;

// Lets a motion be integrated ten times as accurately, or with half of the fixed step.
void refine_steps(Config& scene) {
  const Scene read = read_scene(scene.resolving());
  if (read.is_static()) return;
  const IntegratorSettings settings = read.integrator->settings();
  if (settings.rtol) scene.set("integrator.rtol", *settings.rtol / 10, "integrator.rtol of the refined run");
  else if (settings.step) scene.set("integrator.step", *settings.step / 2, "integrator.step of the refined run");
}

bool any_exact(const PreparedExperiment& experiment) {
  return std::ranges::any_of(experiment.data, &Datum::has_derivatives);
}

// The jobs of one evaluation.
class Plan {
 public:
  Plan(const Problem& problem, const Vector& z, bool with_derivatives, const JobOptions& options, Meshes meshes)
      : problem_(problem), z_(z), with_derivatives_(with_derivatives), options_(options), meshes_(meshes) {}

  void add(const PreparedExperiment& experiment) {
    add(experiment, {}, 0);
    if (!with_derivatives_ || std::ranges::all_of(experiment.data, &Datum::has_derivatives)) return;
    for (std::size_t p = 0; p < problem_.parameters().size(); ++p) {
      if (experiment.paths[p].empty()) continue;
      for (const double sign : {1, -1})
        add(experiment, p, sign * (problem_.coordinates().is_ratio(p) ? kRatioStep : kLogStep));
    }
  }

  Evaluation evaluate() {
    std::vector<EvaluationResult> results(jobs_.size());
    std::string failure;
    const JobEvents events{.ends = [&](std::size_t i, const Json& json, bool cached) {
      results[i] = evaluation_from(json);
      if (results[i].failure && failure.empty())
        failure = fmt::format("{}: {}", jobs_[i].title, results[i].failure->message);
      options_.on_job(jobs_.size(), jobs_[i], results[i], cached);
    }};
    if (!options_.queue.run(jobs_, events)) throw Interrupted();
    if (!failure.empty()) throw Failed(failure);
    return collected(results);
  }

 private:
  // A job: an experiment with the values at z, or with one coordinate moved.
  struct Run {
    const PreparedExperiment* experiment;
    std::optional<std::size_t> parameter;  // whose coordinate is moved
    double step;
  };

  void add(const PreparedExperiment& experiment, std::optional<std::size_t> parameter, double step) {
    Vector moved = z_;
    if (parameter) moved[static_cast<Eigen::Index>(*parameter)] += step;
    const Vector values = problem_.coordinates().values(moved);
    if (!values.allFinite()) throw Failed("the Poisson's ratios that are fixed allow no stable material here");
    Config scene = problem_.scene_with(experiment, values).resolving();
    if (meshes_ == Meshes::refined) {
      refine_mesh(scene, 1);
      if (!experiment.has_modes_only()) refine_steps(scene);
    }
    read_scene(scene);  // fills in the defaults
    EvaluationInput input;
    input.matchings = experiment.matchings;
    input.seconds = problem_.limits().seconds, input.code = code_fingerprint();
    add_metrics(experiment, input);
    // Always, so that the job of a step is the one whose derivatives are needed after the step was accepted.
    if (!parameter && any_exact(experiment) && meshes_ == Meshes::own)
      for (const auto& paths : experiment.paths)
        input.parameters.insert(input.parameters.end(), paths.begin(), paths.end());
    std::string title = experiment.name;
    if (meshes_ == Meshes::refined) title += ", refined mesh";
    if (parameter) title += fmt::format(", {} {}", problem_.parameters()[*parameter].name, step > 0 ? '+' : '-');
    jobs_.push_back(PointJobs(input, problem_.limits(), options_.folder, 1).job(point_scene(scene, title)));
    runs_.push_back({&experiment, parameter, step});
  }

  Evaluation collected(const std::vector<EvaluationResult>& results) const {
    Evaluation out;
    std::vector<Eigen::RowVectorXd> rows;
    const Vector values = problem_.coordinates().values(z_);
    const Eigen::MatrixXd slopes = problem_.coordinates().derivatives(z_);
    for (std::size_t run = 0; run < runs_.size();) {
      const std::size_t begin = run++;
      while (run < runs_.size() && runs_[run].parameter) ++run;
      const PreparedExperiment& experiment = *runs_[begin].experiment;
      const Readings readings(experiment, results[begin], values);
      for (std::size_t d = 0; d < experiment.data.size(); ++d) {
        out.computed.push_back(readings.reading(d));
        out.matches.push_back(readings.match(d));
        if (out.matches.back() && !out.matches.back()->failure.empty())
          throw Failed(fmt::format("{}: {}", experiment.name, out.matches.back()->failure));
        if (!std::isfinite(out.computed.back()))
          throw Failed(fmt::format("{}: there is no {}", experiment.name, experiment.data[d].title));
        if (!with_derivatives_) continue;
        Eigen::RowVectorXd by_value = Eigen::RowVectorXd::Zero(z_.size()), by_coordinate = by_value;
        const bool has_paths = std::ranges::any_of(experiment.paths, [](const auto& paths) { return !paths.empty(); });
        if (has_paths && experiment.data[d].has_derivatives)
          by_value = readings.gain(d) * by_values(experiment, readings.derivatives(d));
        else if (has_paths) by_coordinate = by_differences(results, begin, run, d, values);
        readings.add_derivatives(d, by_value);
        rows.push_back(by_value * slopes + by_coordinate);
      }
    }
    if (!with_derivatives_) return out;
    Eigen::MatrixXd all(rows.size(), z_.size());
    for (std::size_t i = 0; i < rows.size(); ++i) all.row(static_cast<Eigen::Index>(i)) = rows[i];
    out.derivatives = all;
    return out;
  }

  // Derivatives by parameter value, from those by path.
  Eigen::RowVectorXd by_values(const PreparedExperiment& experiment, const std::vector<double>& by_path) const {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(z_.size());
    std::size_t next = 0;
    for (std::size_t p = 0; p < experiment.paths.size(); ++p)
      for (std::size_t i = 0; i < experiment.paths[p].size(); ++i)
        row[static_cast<Eigen::Index>(p)] += by_path.at(next++);
    return row;
  }

  // Derivatives of a reading by coordinate from the pairs of runs after `begin`, with `values` of the nuisances.
  Eigen::RowVectorXd by_differences(const std::vector<EvaluationResult>& results, std::size_t begin, std::size_t end,
                                    std::size_t datum, const Vector& values) const {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(z_.size());
    const auto reading = [&](std::size_t run) {
      return Readings(*runs_[run].experiment, results[run], values).reading(datum);
    };
    for (std::size_t run = begin + 1; run + 1 < end; run += 2)
      row[static_cast<Eigen::Index>(*runs_[run].parameter)] = (reading(run) - reading(run + 1)) / (2 * runs_[run].step);
    return row;
  }

  const Problem& problem_;
  const Vector& z_;
  bool with_derivatives_;
  const JobOptions& options_;
  Meshes meshes_;
  std::vector<Run> runs_;
  std::vector<Job> jobs_;
};

}  // namespace

Evaluation evaluate(const Problem& problem, const Vector& z, bool with_derivatives, const JobOptions& options,
                    Experiments which, Meshes meshes) {
  Plan plan(problem, z, with_derivatives, options, meshes);
  try {
    for (const PreparedExperiment& experiment : problem.experiments())
      if (experiment.is_candidate == (which == Experiments::candidates)) plan.add(experiment);
  } catch (const ConfigError& e) {
    throw Failed(e.what());
  }
  return plan.evaluate();
}

}  // namespace orthodyn::study::fit
