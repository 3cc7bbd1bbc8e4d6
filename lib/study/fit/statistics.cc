#include "lib/study/fit/statistics.h"

#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>

namespace orthodyn::study::fit {

namespace {

constexpr double kNormal95 = 1.959963984540054;  // 97.5 % quantile of the normal distribution
constexpr double kRankTolerance = 1e-10;         // smallest singular value over the largest
constexpr double kSuspicious = 0.01;             // probability below which the residuals are no noise
constexpr std::size_t kFewestForRuns = 10;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

using Svd = Eigen::BDCSVD<Eigen::MatrixXd>;

Svd svd_of(const Eigen::MatrixXd& weighted) {
  // Rows of zeros, so that V has all columns also if there are fewer data than parameters.
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(std::max(weighted.rows(), weighted.cols()), weighted.cols());
  padded.topRows(weighted.rows()) = weighted;
  constexpr int kSmall = 100;  // Jacobi rotations up to so many columns; more would take minutes
  Svd svd;
  svd.setSwitchSize(kSmall);
  svd.compute(padded, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return svd;
}

bool is_determined(const Svd& svd, Eigen::Index k) {
  return svd.singularValues()[k] > kRankTolerance * svd.singularValues()[0];
}

// Variances that are infinite where a coordinate has a part in an undetermined direction.
Eigen::MatrixXd covariance_of(const Svd& svd) {
  const Eigen::Index n = svd.matrixV().rows();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    if (is_determined(svd, k))
      out += svd.matrixV().col(k) * svd.matrixV().col(k).transpose() / std::pow(svd.singularValues()[k], 2);
  constexpr double kPart = 1e-6;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (is_determined(svd, k)) continue;
    for (Eigen::Index i = 0; i < n; ++i)
      if (std::abs(svd.matrixV()(i, k)) > kPart) out(i, i) = kInfinity;
  }
  return out;
}

std::optional<double> runs_probability(const Eigen::VectorXd& residuals) {
  double above = 0, below = 0, runs = 0;
  int last = 0;
  for (const double r : residuals) {
    if (r == 0) continue;
    const int sign = r > 0 ? 1 : -1;
    (sign > 0 ? above : below) += 1;
    if (sign != last) ++runs;
    last = sign;
  }
  const double n = above + below;
  if (n < kFewestForRuns || above == 0 || below == 0) return {};
  const double mean = 2 * above * below / n + 1;
  const double variance = (mean - 1) * (mean - 2) / (n - 1);
  if (!(variance > 0)) return {};
  return 0.5 * std::erfc((mean - runs) / std::sqrt(2 * variance));
}

// Degrees of freedom of the data beside a field, whose smoothness is not data: their number less the trace of their
// part of the hat matrix U U^T, which is the effective number of parameters.
long freedom_beside_field(const Svd& svd, Eigen::Index data) {
  double parameters = 0;
  for (Eigen::Index k = 0; k < svd.singularValues().size(); ++k)
    if (is_determined(svd, k)) parameters += svd.matrixU().col(k).head(data).squaredNorm();
  return static_cast<long>(data) - std::lround(parameters);
}

NoiseTest noise_test(const Residuals& residuals, std::size_t data, long rank, const Svd& svd, bool has_field) {
  NoiseTest out;
  const auto count = static_cast<Eigen::Index>(data);
  out.chi_square = has_field ? residuals.values.head(count).squaredNorm() : residuals.values.squaredNorm();
  out.freedom = has_field ? freedom_beside_field(svd, count) : residuals.values.size() - rank;
  out.runs_probability = runs_probability(residuals.values.head(static_cast<Eigen::Index>(data)));
  // Beside a field, the number of parameters has no meaning.
  if (has_field) out.information_criterion = kUnknown;
  else
    out.information_criterion = out.chi_square + static_cast<double>(residuals.derivatives.cols()) *
                                                     std::log(static_cast<double>(residuals.values.size()));
  if (out.freedom <= 0) return out;
  const auto freedom = static_cast<double>(out.freedom);
  out.probability = boost::math::gamma_q(freedom / 2, out.chi_square / 2);
  if (*out.probability < kSuspicious) out.factor = std::sqrt(out.chi_square / freedom);
  return out;
}

Knowledge knowledge_of(const Estimate& estimate, bool is_ratio) {
  constexpr double kNothing = 1, kWell = 0.1, kWellOfRatios = 0.05;
  if (!(estimate.deviation_z < kNothing)) return Knowledge::undetermined;
  const bool is_well = is_ratio ? estimate.deviation < kWellOfRatios : estimate.deviation_z < kWell;
  return is_well ? Knowledge::determined : Knowledge::poorly_determined;
}

Estimate estimate_of(const Problem& problem, const Vector& z, const Vector& values, const Eigen::MatrixXd& slopes,
                     const Eigen::MatrixXd& covariance, Eigen::Index p) {
  Estimate out;
  out.value = values[p];
  out.deviation_z = std::sqrt(covariance(p, p));
  // A ratio's value depends on other coordinates, too.
  const Eigen::RowVectorXd slope = slopes.row(p);
  out.deviation = 0;
  for (Eigen::Index i = 0; i < slope.size(); ++i)
    if (slope[i] != 0 && !std::isfinite(covariance(i, i))) out.deviation = kInfinity;
  if (std::isfinite(out.deviation)) {
    Eigen::MatrixXd finite = covariance;
    for (Eigen::Index i = 0; i < slope.size(); ++i)
      if (!std::isfinite(finite(i, i))) finite(i, i) = 0;
    out.deviation = std::sqrt(std::max(0.0, (slope * finite * slope.transpose())(0, 0)));
  }
  const auto index = static_cast<std::size_t>(p);
  if (problem.coordinates().is_log(index)) {
    out.low = out.value * std::exp(-kNormal95 * out.deviation_z);
    out.high = out.value * std::exp(kNormal95 * out.deviation_z);
  } else {
    out.low = out.value - kNormal95 * out.deviation;
    out.high = out.value + kNormal95 * out.deviation;
  }
  out.knowledge = knowledge_of(out, problem.coordinates().is_ratio(index));
  const FittedParameter& parameter = problem.parameters()[index];
  const auto is_at = [&](const std::optional<double>& bound) {
    return bound && std::abs(z[p] - problem.coordinates().at(index, *bound)) < 1e-9 * (1 + std::abs(z[p]));
  };
  out.at_bound = is_at(parameter.lower) || is_at(parameter.upper);
  return out;
}

Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& covariance) {
  Eigen::MatrixXd out = covariance;
  for (Eigen::Index i = 0; i < out.rows(); ++i)
    for (Eigen::Index j = 0; j < out.cols(); ++j) {
      const double both = std::sqrt(covariance(i, i) * covariance(j, j));
      out(i, j) = i == j ? 1 : std::isfinite(both) && both > 0 ? covariance(i, j) / both : kUnknown;
    }
  return out;
}

// Residuals at the end of the search, with the weights of the loss.
Residuals at_end(const Problem& problem, const Search& search, Loss loss) {
  const Residuals residuals = residuals_of(problem, search.z, search.at);
  return weighted_by_loss(problem, residuals, residuals, loss);
}

}  // namespace

Statistics statistics_of(const Problem& problem, const Search& search, Loss loss) {
  const Residuals residuals = at_end(problem, search, loss);
  const Svd svd = svd_of(residuals.derivatives);
  const Eigen::Index n = search.z.size();
  long rank = 0;
  for (Eigen::Index k = 0; k < n; ++k) rank += is_determined(svd, k);
  Statistics out;
  out.noise = noise_test(residuals, problem.data().size(), rank, svd, !problem.fields().empty());
  out.covariance = std::pow(out.noise.factor, 2) * covariance_of(svd);
  out.correlation = correlation_of(out.covariance);
  for (Eigen::Index k = n; k-- > 0;)
    out.directions.push_back(
        {is_determined(svd, k) ? out.noise.factor / svd.singularValues()[k] : kInfinity, svd.matrixV().col(k)});
  const Vector values = problem.coordinates().values(search.z);
  const Eigen::MatrixXd slopes = problem.coordinates().derivatives(search.z);
  for (Eigen::Index p = 0; p < n; ++p)
    out.estimates.push_back(estimate_of(problem, search.z, values, slopes, out.covariance, p));
  return out;
}

Vector shift_by_refinement(const Problem& problem, const Search& search, Loss loss, const Evaluation& refined) {
  const Residuals own = at_end(problem, search, loss);
  const Residuals finer = weighted_by_loss(problem, residuals_of(problem, search.z, refined),
                                           residuals_of(problem, search.z, search.at), loss);
  const Svd svd = svd_of(own.derivatives);
  Vector step = Vector::Zero(search.z.size());
  Eigen::VectorXd change = Eigen::VectorXd::Zero(svd.matrixU().rows());
  change.head(own.values.size()) = finer.values - own.values;
  for (Eigen::Index k = 0; k < step.size(); ++k)
    if (is_determined(svd, k))
      step -= svd.matrixV().col(k) * (svd.matrixU().col(k).dot(change) / svd.singularValues()[k]);
  return problem.coordinates().derivatives(search.z) * step;
}

std::vector<CandidateValue> values_of_candidates(const Problem& problem, const Search& search, Loss loss,
                                                 const Statistics& statistics, const Evaluation& at) {
  // Without a prior, the gains would be infinite if the data leave a parameter undetermined. The prior's standard
  // deviation is 1 in z: a factor e of a logarithmic parameter.
  constexpr double kPriorDeviation = 1;
  const Eigen::Index n = search.z.size();
  const Eigen::MatrixXd own = at_end(problem, search, loss).derivatives / statistics.noise.factor;
  const Eigen::MatrixXd information =
      own.transpose() * own + Eigen::MatrixXd::Identity(n, n) / std::pow(kPriorDeviation, 2);
  const Eigen::MatrixXd rows = weighted(problem, at, Experiments::candidates);
  const Eigen::MatrixXd slopes = problem.coordinates().derivatives(search.z);
  const auto log_determinant = [](const Eigen::MatrixXd& a) {
    return a.llt().matrixL().toDenseMatrix().diagonal().array().log().sum();
  };
  std::vector<CandidateValue> out;
  Eigen::Index first = 0;
  for (const PreparedExperiment& experiment : problem.experiments()) {
    if (!experiment.is_candidate) continue;
    const auto count = static_cast<Eigen::Index>(experiment.data.size());
    const Eigen::MatrixXd more = rows.middleRows(first, count);
    first += count;
    const Eigen::MatrixXd with = information + more.transpose() * more;
    CandidateValue value{experiment.name, {}};
    value.determinant_gain = std::exp(log_determinant(with) - log_determinant(information));
    const Eigen::MatrixXd covariance = with.inverse();
    value.trace_gain = information.inverse().trace() / covariance.trace();
    for (Eigen::Index p = 0; p < n; ++p)
      value.deviations.push_back(std::sqrt((slopes.row(p) * covariance * slopes.row(p).transpose())(0, 0)));
    out.push_back(value);
  }
  return out;
}

}  // namespace orthodyn::study::fit
