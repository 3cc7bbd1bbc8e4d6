// The search for the parameter values of least weighted squares, by the Levenberg-Marquardt method of Ceres.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lib/study/fit/problem.h"

namespace orthodyn::study::fit {

// What the fit minimises. Residuals are (computed - measured) / deviation, of the data, the priors and the smoothness
// of fields, in this order.
struct Residuals {
  Eigen::VectorXd values;
  Eigen::MatrixXd derivatives;  // d residual / d z; empty if not computed
};

// Residuals at z, given the evaluation there.
Residuals residuals_of(const Problem& problem, const Vector& z, const Evaluation& at);

// The residuals with the weights sqrt(rho'(r^2)) of the loss rho, by which its minimum is one of least squares. Priors
// have weight 1.
Residuals weighted_by_loss(const Problem& problem, Residuals residuals, const Residuals& weights_at, Loss loss);

// Rows d computed / d z / deviation of data without priors.
Eigen::MatrixXd weighted(const Problem& problem, const Evaluation& at, Experiments which);

struct Iteration {
  int number = 0;
  double chi_square = 0;  // sum of squared residuals, with the loss
  Vector values;          // parameters, SI
  bool accepted = true;
  std::string failure;  // why the data could not be computed at a rejected step, or ""
};

struct Search {
  Vector start, z;  // coordinates at the start and at the end
  bool converged = false;
  std::string message;       // why the search ended
  double cost = 0;           // minimised: half the sum of squared residuals, with the loss
  Evaluation at;             // at the end, with derivatives
  Vector computed_at_start;  // data at the start, SI
  std::vector<std::optional<ModeMatch>> matches_at_start;
  std::vector<Iteration> iterations;
  std::size_t evaluations = 0, failed_evaluations = 0;
};

// Searches from z. `on_iteration` is called after each iteration. `fixed`: a parameter whose coordinate is kept. Throws
// Failed if the data cannot be computed at the start, ConfigError if a parameter changes no datum, RunError if this
// build has no Ceres; Interrupted.
Search search(const Problem& problem, const Fit& fit, const Vector& start, const JobOptions& options,
              const std::function<void(const Iteration&)>& on_iteration, std::optional<std::size_t> fixed = {});

// Starts of all searches: the parameters' own start, then points of a Latin hypercube.
std::vector<Vector> starts_of(const Problem& problem, const Fit& fit);

}  // namespace orthodyn::study::fit
