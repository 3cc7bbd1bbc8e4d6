#include "lib/study/fit/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

#ifdef ORTHODYN_CERES
#include <ceres/ceres.h>
#endif

#include "lib/core/errors.h"
#include "lib/study/sweep/latin_hypercube.h"

namespace orthodyn::study::fit {

namespace {

// Parameters with a prior, in the order of their residuals.
std::vector<std::size_t> with_priors(const Problem& problem) {
  std::vector<std::size_t> out;
  for (std::size_t p = 0; p < problem.parameters().size(); ++p)
    if (problem.parameters()[p].prior) out.push_back(p);
  return out;
}

}  // namespace

Eigen::MatrixXd weighted(const Problem& problem, const Evaluation& at, Experiments which) {
  Eigen::MatrixXd out = *at.derivatives;
  const auto data = problem.data(which);
  for (std::size_t i = 0; i < data.size(); ++i)
    if (const double deviation = data[i]->deviation_at(at.computed[i]); deviation > 0)
      out.row(static_cast<Eigen::Index>(i)) /= deviation;
    else out.row(static_cast<Eigen::Index>(i)).setZero();  // a candidate whose value is 0, with a relative deviation
  return out;
}

Residuals residuals_of(const Problem& problem, const Vector& z, const Evaluation& at) {
  const auto data = problem.data();
  const auto priors = with_priors(problem);
  const auto count = static_cast<Eigen::Index>(data.size());
  Eigen::Index all = count + static_cast<Eigen::Index>(priors.size());
  for (const ParameterField& field : problem.fields()) all += std::ssize(field.neighbours());
  Residuals out{Eigen::VectorXd(all), {}};
  for (std::size_t i = 0; i < data.size(); ++i)
    out.values[static_cast<Eigen::Index>(i)] = (at.computed[i] - data[i]->value) / data[i]->deviation;
  if (at.derivatives) {
    out.derivatives.setZero(all, z.size());
    out.derivatives.topRows(count) = weighted(problem, at, Experiments::measured);
  }
  const auto set_smoothness = [&](Eigen::Index row) {
    for (const ParameterField& field : problem.fields())
      for (const auto& [a, b] : field.neighbours()) {
        const auto i = static_cast<Eigen::Index>(a), j = static_cast<Eigen::Index>(b);
        out.values[row] = (z[i] - z[j]) / field.smoothness;
        if (at.derivatives) out.derivatives(row, i) = 1 / field.smoothness;
        if (at.derivatives) out.derivatives(row, j) = -1 / field.smoothness;
        ++row;
      }
  };
  set_smoothness(count + std::ssize(priors));
  if (priors.empty()) return out;
  const Vector values = problem.coordinates().values(z);
  const Eigen::MatrixXd slopes = problem.coordinates().derivatives(z);
  for (std::size_t k = 0; k < priors.size(); ++k) {
    const auto p = static_cast<Eigen::Index>(priors[k]), row = count + static_cast<Eigen::Index>(k);
    const FittedParameter& parameter = problem.parameters()[priors[k]];
    out.values[row] = (values[p] - *parameter.prior) / *parameter.deviation;
    if (at.derivatives) out.derivatives.row(row) = slopes.row(p) / *parameter.deviation;
  }
  return out;
}

namespace {

// rho'(r^2) of the losses of Ceres with scale 1.
double weight_of(double residual, Loss loss) {
  switch (loss) {
    case Loss::huber: return 1 / std::max(1.0, std::abs(residual));
    case Loss::cauchy: return 1 / (1 + residual * residual);
    case Loss::squares: break;
  }
  return 1;
}

}  // namespace

Residuals weighted_by_loss(const Problem& problem, Residuals residuals, const Residuals& weights_at, Loss loss) {
  for (Eigen::Index i = 0; i < std::ssize(problem.data()); ++i) {
    const double weight = std::sqrt(weight_of(weights_at.values[i], loss));
    residuals.values[i] *= weight;
    if (residuals.derivatives.size() > 0) residuals.derivatives.row(i) *= weight;
  }
  return residuals;
}

std::vector<Vector> starts_of(const Problem& problem, const Fit& fit) {
  const auto& parameters = problem.parameters();
  const Coordinates& coordinates = problem.coordinates();
  const auto n = static_cast<Eigen::Index>(parameters.size());
  Vector values(n);
  for (Eigen::Index p = 0; p < n; ++p) values[p] = parameters[static_cast<std::size_t>(p)].start;
  const Vector own = coordinates.at(values);
  if (!own.allFinite())
    fit.origin.fail("the start values are no stable material; give other start values of Poisson's ratios or moduli");
  std::vector<Vector> out{own};
  const auto shares = latin_hypercube(fit.starts, static_cast<int>(n), fit.seed);
  for (int k = 1; k < fit.starts; ++k) {
    Vector z = own;
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto p = static_cast<std::size_t>(i);
      if (parameters[p].is_nuisance) continue;
      const double half = std::log(fit.spread);  // of ratios and linear coordinates likewise
      double low = own[i] - half, high = own[i] + half;
      if (parameters[p].lower) low = coordinates.at(p, *parameters[p].lower);
      if (parameters[p].upper) high = coordinates.at(p, *parameters[p].upper);
      z[i] = low + (high - low) * shares[static_cast<std::size_t>(k)][p];
    }
    out.push_back(z);
  }
  return out;
}

#ifdef ORTHODYN_CERES

namespace {

// Evaluates all data when Ceres moves to another point, and keeps the result for the cost functions of the data.
class SharedEvaluation : public ceres::EvaluationCallback {
 public:
  SharedEvaluation(const Problem& problem, const JobOptions& options, Vector& z)
      : problem_(problem), options_(options), z_(z) {}

  // Exceptions must not pass through Ceres; a pending one ends the search.
  void PrepareForEvaluation(bool with_derivatives, bool) override {
    if (pending_) return;
    const bool is_here = at_.size() == z_.size() && at_ == z_;
    if (is_here && (!with_derivatives || !succeeded_ || residuals_.derivatives.size() > 0)) return;
    at_ = z_;
    ++evaluations;
    try {
      evaluation_ = evaluate(problem_, z_, with_derivatives, options_);
      residuals_ = residuals_of(problem_, z_, evaluation_);
      if (first_.computed.empty()) first_ = evaluation_;
      succeeded_ = true;
    } catch (const Failed& e) {
      ++failed;
      succeeded_ = false;
      failure_ = e.what();
    } catch (...) {
      succeeded_ = false;
      pending_ = std::current_exception();
    }
  }

  bool succeeded() const { return succeeded_; }
  const std::string& failure() const { return failure_; }
  const Residuals& residuals() const { return residuals_; }
  const Evaluation& evaluation() const { return evaluation_; }
  const Evaluation& first() const { return first_; }
  bool must_end() const { return pending_ != nullptr; }
  void rethrow() const {
    if (pending_) std::rethrow_exception(pending_);
  }
  std::size_t evaluations = 0, failed = 0;

 private:
  const Problem& problem_;
  const JobOptions& options_;
  Vector& z_;  // changed by Ceres
  Vector at_;
  Evaluation first_, evaluation_;
  Residuals residuals_;
  bool succeeded_ = false;
  std::string failure_;
  std::exception_ptr pending_;
};

// One residual. Each has its own cost function, so that the loss applies to each datum.
class ResidualCost : public ceres::CostFunction {
 public:
  ResidualCost(const SharedEvaluation& shared, Eigen::Index row, Eigen::Index parameters) : shared_(shared), row_(row) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters));
  }
  bool Evaluate(double const* const*, double* residual, double** derivatives) const override {
    if (!shared_.succeeded()) return false;
    *residual = shared_.residuals().values[row_];
    if (derivatives && derivatives[0]) {
      const auto row = shared_.residuals().derivatives.row(row_);
      std::copy(row.begin(), row.end(), derivatives[0]);
    }
    return true;
  }

 private:
  const SharedEvaluation& shared_;
  Eigen::Index row_;
};

ceres::LossFunction* loss_of(Loss loss) {
  switch (loss) {
    case Loss::huber: return new ceres::HuberLoss(1);
    case Loss::cauchy: return new ceres::CauchyLoss(1);
    case Loss::squares: break;
  }
  return nullptr;
}

class Progress : public ceres::IterationCallback {
 public:
  Progress(const Problem& problem, const SharedEvaluation& shared, const Vector& z, std::vector<Iteration>& iterations,
           const std::function<void(const Iteration&)>& on_iteration)
      : problem_(problem), shared_(shared), z_(z), iterations_(iterations), on_iteration_(on_iteration) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (shared_.must_end()) return ceres::SOLVER_ABORT;
    const bool accepted = summary.iteration == 0 || summary.step_is_successful;
    iterations_.push_back({summary.iteration, 2 * summary.cost, problem_.coordinates().values(z_), accepted,
                           accepted || shared_.failed == failed_ ? "" : shared_.failure()});
    on_iteration_(iterations_.back());
    return is_settled(summary) ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  // Whether the search ends, because further steps hardly change the sum of squares: the last step was rejected and
  // changed the sum by at most 1e-4 of it, or the last three steps were accepted and each changed it by so little. Near
  // the minimum, errors of the runs (of the time integration, for example) hide the slope. A failed run does not end
  // the search.
  bool is_settled(const ceres::IterationSummary& summary) {
    constexpr double kNegligible = 1e-4;
    constexpr int kAccepted = 3;
    const bool failed = shared_.failed > failed_;
    failed_ = shared_.failed;
    const bool is_step = summary.iteration > 0 && summary.step_is_valid && !failed;
    if (!is_step || std::abs(summary.cost_change) > kNegligible * summary.cost) {
      negligible_ = 0;
      return false;
    }
    return !summary.step_is_successful || ++negligible_ == kAccepted;
  }

  const Problem& problem_;
  const SharedEvaluation& shared_;
  const Vector& z_;
  std::vector<Iteration>& iterations_;
  const std::function<void(const Iteration&)>& on_iteration_;
  std::size_t failed_ = 0;
  int negligible_ = 0;
};

void require_effects(const Problem& problem, const Residuals& at_start) {
  for (Eigen::Index p = 0; p < at_start.derivatives.cols(); ++p) {
    if (at_start.derivatives.col(p).lpNorm<Eigen::Infinity>() > 0) continue;
    const FittedParameter& parameter = problem.parameters()[static_cast<std::size_t>(p)];
    parameter.origin.fail(
        fmt::format("'{}' changes none of the measured quantities; leave it out, or measure a quantity "
                    "that depends on it",
                    parameter.is_nuisance ? parameter.name : parameter.paths.front()));
  }
}

void set_bounds(ceres::Problem& ceres, const Problem& problem, Vector& z) {
  for (std::size_t p = 0; p < problem.parameters().size(); ++p) {
    const FittedParameter& parameter = problem.parameters()[p];
    const auto at = [&](double value) { return problem.coordinates().at(p, value); };
    if (parameter.lower) ceres.SetParameterLowerBound(z.data(), static_cast<int>(p), at(*parameter.lower));
    if (parameter.upper) ceres.SetParameterUpperBound(z.data(), static_cast<int>(p), at(*parameter.upper));
  }
}

}  // namespace

Search search(const Problem& problem, const Fit& fit, const Vector& start, const JobOptions& options,
              const std::function<void(const Iteration&)>& on_iteration, std::optional<std::size_t> fixed) {
  Search out;
  out.start = out.z = start;
  SharedEvaluation shared(problem, options, out.z);
  shared.PrepareForEvaluation(true, true);
  shared.rethrow();
  if (!shared.succeeded()) throw Failed("the measured quantities cannot be computed at the start: " + shared.failure());
  require_effects(problem, shared.residuals());

  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &shared;
  ceres::Problem ceres(problem_options);
  const std::size_t data = problem.data().size();
  for (Eigen::Index row = 0; row < shared.residuals().values.size(); ++row)
    ceres.AddResidualBlock(new ResidualCost(shared, row, start.size()),
                           static_cast<std::size_t>(row) < data ? loss_of(fit.loss) : nullptr, out.z.data());
  set_bounds(ceres, problem, out.z);
  if (fixed && out.z.size() == 1) ceres.SetParameterBlockConstant(out.z.data());
  if (fixed && out.z.size() > 1)
    ceres.SetManifold(out.z.data(),
                      new ceres::SubsetManifold(static_cast<int>(out.z.size()), {static_cast<int>(*fixed)}));
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = fit.iterations;
  solver.parameter_tolerance = fit.tolerance;
  // Near its minimum the sum of squares is quadratic; smaller changes of it are rounding errors.
  solver.function_tolerance = std::max(std::pow(fit.tolerance, 2), 1e-13);
  solver.gradient_tolerance = 1e-12;
  solver.max_num_consecutive_invalid_steps = 20;
  solver.logging_type = ceres::SILENT;
  solver.update_state_every_iteration = true;
  Progress progress(problem, shared, out.z, out.iterations, on_iteration);
  solver.callbacks.push_back(&progress);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &ceres, &summary);
  shared.rethrow();

  shared.PrepareForEvaluation(true, true);  // derivatives at the end
  shared.rethrow();
  if (!shared.succeeded()) throw Failed(shared.failure());
  const bool has_settled = summary.termination_type == ceres::USER_SUCCESS;
  out.converged = has_settled || summary.termination_type == ceres::CONVERGENCE;
  out.message = has_settled ? "further steps change chi-square by less than 1e-4 of it" : summary.message;
  out.cost = summary.final_cost;
  out.at = shared.evaluation();
  out.computed_at_start = Eigen::Map<const Vector>(shared.first().computed.data(), std::ssize(shared.first().computed));
  out.matches_at_start = shared.first().matches;
  out.evaluations = shared.evaluations, out.failed_evaluations = shared.failed;
  return out;
}

#else

Search search(const Problem&, const Fit&, const Vector&, const JobOptions&,
              const std::function<void(const Iteration&)>&, std::optional<std::size_t>) {
  throw RunError("this build of orthodyn has no Ceres, which fits need; build with -D ORTHODYN_CERES=ON");
}

#endif

}  // namespace orthodyn::study::fit
