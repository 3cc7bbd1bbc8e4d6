// A fit as a problem of least squares: parameter values in, computed data and their derivatives out. Each evaluation
// runs the scenes of the experiments as jobs, whose results are kept on disk: a repeated or resumed fit does not run
// them again.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "lib/study/fit/coordinates.h"
#include "lib/study/fit/data.h"
#include "lib/study/fit/field.h"
#include "lib/study/jobs/job_queue.h"
#include "lib/study/points/point_jobs.h"

namespace orthodyn::study::fit {

// A parameter and what the scenes say about it.
struct FittedParameter {
  std::string name, unit;  // of display
  double factor = 1;       // from `unit` to SI
  std::vector<std::string> paths;
  double start = 0;                        // SI
  std::optional<double> lower, upper;      // SI
  std::optional<double> prior, deviation;  // SI; of the prior
  bool is_nuisance = false;                // gain, offset or time offset of a measurement, without a path
  SourceLocation origin = {};
};

// An experiment with its scene. All experiments of a fit are in one list, candidates after the others.
struct PreparedExperiment {
  std::string name;
  Config scene;  // resolved
  std::vector<Datum> data;
  std::vector<ModeMatching> matchings;          // of Datum::metric
  std::vector<SampledSeries> series;            // of Datum::series
  std::vector<std::vector<std::string>> paths;  // by parameter: those that the scene has
  bool is_candidate = false;

  // Whether only natural frequencies of the scene are measured, for which it needs no time span and no loads.
  bool has_modes_only() const;
};

// Data of one evaluation, in the order of the data of all experiments in question.
struct Evaluation {
  std::vector<double> computed;                   // SI
  std::vector<std::optional<ModeMatch>> matches;  // the computed modes of measured ones; empty for other data
  std::optional<Eigen::MatrixXd> derivatives;     // d computed / d z
};

// A selection of experiments.
enum class Experiments { measured, candidates };
// The scenes' own meshes and time steps, or those refined once.
enum class Meshes { own, refined };

// Where and how jobs are run.
struct JobOptions {
  std::filesystem::path folder;
  JobQueue queue;
  // Called for each job that ended. `count`: number of jobs of this evaluation.
  std::function<void(std::size_t count, const Job& job, const EvaluationResult& result, bool cached)> on_job;
};

class Problem {
 public:
  // Reads scenes, tables and parameters. Throws ConfigError before anything runs: unknown paths and quantities, wrong
  // units, fewer data than parameters.
  explicit Problem(const Fit& fit);

  const std::vector<FittedParameter>& parameters() const { return parameters_; }
  const std::vector<ParameterField>& fields() const { return fields_; }
  // The parameters that are not part of a field.
  std::vector<std::size_t> single_parameters() const;
  const std::vector<PreparedExperiment>& experiments() const { return experiments_; }
  const Coordinates& coordinates() const { return coordinates_; }
  const Limits& limits() const { return limits_; }
  std::vector<const Datum*> data(Experiments which = Experiments::measured) const;

  // The scene of an experiment with these values. Throws ConfigError if they are not allowed.
  Config scene_with(const PreparedExperiment& experiment, const Vector& values) const;

 private:
  void prepare(const Named<Experiment>& experiments, bool are_candidates);
  void add_parameter(const std::string& name, const Parameter& parameter);
  void add_field(const std::string& name, const Parameter& parameter, const Config& scene);
  void add_coordinate(const Parameter& parameter, const FittedParameter& fitted, const Config& scene);
  void add_nuisances(const Fit& fit);  // nuisances.cc
  void require_enough_data(const Fit& fit) const;

  Limits limits_;
  std::vector<PreparedExperiment> experiments_;
  std::vector<FittedParameter> parameters_;
  std::vector<ParameterField> fields_;
  Coordinates coordinates_;
};

// Computes the data at the coordinates z, and their derivatives if wanted. Throws Failed if a scene cannot be run with
// these values or its run failed; Interrupted if the queue was interrupted.
Evaluation evaluate(const Problem& problem, const Vector& z, bool with_derivatives, const JobOptions& options,
                    Experiments which = Experiments::measured, Meshes meshes = Meshes::own);

// Thrown if the data cannot be computed with these parameter values.
class Failed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Thrown if the user interrupted the runs.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace orthodyn::study::fit
