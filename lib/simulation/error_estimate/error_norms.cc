#include "lib/simulation/error_estimate/error_norms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "lib/core/symmetric_eigen.h"
#include "lib/simulation/error_estimate/dominant_frequency.h"
#include "lib/simulation/error_estimate/recorders.h"

namespace orthodyn {

namespace {

// Final, rms and largest of the distances, relative to a scale.
ErrorNorms summarise(const std::vector<double>& distances, double scale) {
  if (scale == 0) scale = std::numeric_limits<double>::quiet_NaN();
  double squares = 0, largest = 0;
  for (const double d : distances) {
    squares += d * d;
    if (!(d <= largest)) largest = d;  // keeps NaN
  }
  return {distances.back() / scale, std::sqrt(squares / static_cast<double>(distances.size())) / scale,
          largest / scale};
}

double largest(const std::vector<double>& x) { return *std::max_element(x.begin(), x.end()); }

// Length of the probe's displacement in each column.
std::vector<double> lengths(const ProbePoint& probe, const Eigen::MatrixXd& q) {
  std::vector<double> out;
  for (Eigen::Index k = 0; k < q.cols(); ++k) {
    double squares = 0;
    for (const int dof : probe.dofs)
      if (dof >= 0) squares += q(dof, k) * q(dof, k);
    out.push_back(std::sqrt(squares));
  }
  return out;
}

// Norm of each quantity in each column.
std::vector<std::vector<double>> sizes(const std::vector<FollowedQuantity>& quantities, const Eigen::MatrixXd& values) {
  std::vector<std::vector<double>> all;
  Eigen::Index row = 0;
  for (const auto& quantity : quantities) {
    const Eigen::RowVectorXd size = values.middleRows(row, quantity.components).colwise().norm();
    all.emplace_back(size.begin(), size.end());
    row += quantity.components;
  }
  return all;
}

double interval(const Trajectory& t) {
  return (t.times.back() - t.times.front()) / static_cast<double>(t.times.size() - 1);
}

}  // namespace

ReferenceNorms::ReferenceNorms(const FemModel& model, Trajectory reference, std::vector<ProbePoint> probes,
                               std::vector<FollowedQuantity> quantities)
    : ReferenceNorms([&model](const Eigen::MatrixXd& x) { return global_mass_product(model, x); }, std::move(reference),
                     std::move(probes), std::move(quantities)) {}

ReferenceNorms::ReferenceNorms(Metric metric, Trajectory reference, std::vector<ProbePoint> probes,
                               std::vector<FollowedQuantity> quantities)
    : metric_(std::move(metric)),
      reference_(std::move(reference)),
      probes_(std::move(probes)),
      quantities_(std::move(quantities)) {
  scales_.displacement = largest(norms(reference_.q));
  scales_.velocity = largest(norms(reference_.v));
  for (const auto& probe : probes_) scales_.probes.emplace_back(probe.name, largest(lengths(probe, reference_.q)));
  const auto size = sizes(quantities_, reference_.quantities);
  for (std::size_t k = 0; k < quantities_.size(); ++k)
    scales_.quantities.emplace_back(quantities_[k].name, largest(size[k]));
  scales_.dominant_frequency = std::numeric_limits<double>::quiet_NaN();
  const Vector mode = leading_mode();
  if (const auto omega = dominant_frequency(reference_.q.transpose() * mode, interval(reference_))) {
    scales_.dominant_frequency = *omega / (2 * std::numbers::pi);
    mode_ = mode;
  }
}

// M times the dominant mode of the reference's motion about its mean (proper orthogonal decomposition by the method of
// snapshots; Sirovich 1987).
Vector ReferenceNorms::leading_mode() const {
  const Eigen::MatrixXd motion = reference_.q.colwise() - reference_.q.rowwise().mean();
  const Eigen::MatrixXd weighted = metric_(motion);
  const auto modes = symmetric_eigenpairs(Eigen::MatrixXd(motion.transpose() * weighted));
  return weighted * modes.vectors.rightCols<1>();
}

std::vector<double> ReferenceNorms::norms(const Eigen::MatrixXd& x) const {
  const Eigen::MatrixXd weighted = metric_(x);
  std::vector<double> out;
  for (Eigen::Index k = 0; k < x.cols(); ++k) out.push_back(std::sqrt(std::max(x.col(k).dot(weighted.col(k)), 0.0)));
  return out;
}

TrajectoryErrors ReferenceNorms::errors(const Trajectory& trajectory) const {
  if (trajectory.q.rows() != reference_.q.rows() || trajectory.times != reference_.times ||
      trajectory.quantities.rows() != reference_.quantities.rows())
    throw std::logic_error("trajectory and reference do not match");
  const Eigen::MatrixXd dq = trajectory.q - reference_.q;
  TrajectoryErrors errors;
  errors.displacement = summarise(norms(dq), scales_.displacement);
  errors.velocity = summarise(norms(trajectory.v - reference_.v), scales_.velocity);
  for (std::size_t p = 0; p < probes_.size(); ++p)
    errors.probes.emplace_back(probes_[p].name, summarise(lengths(probes_[p], dq), scales_.probes[p].second));
  const auto differences = sizes(quantities_, trajectory.quantities - reference_.quantities);
  for (std::size_t k = 0; k < quantities_.size(); ++k)
    errors.quantities.emplace_back(quantities_[k].name, summarise(differences[k], scales_.quantities[k].second));
  errors.phase = std::numeric_limits<double>::quiet_NaN();
  if (mode_.size() > 0)
    errors.phase = phase_difference(trajectory.q.transpose() * mode_, reference_.q.transpose() * mode_,
                                    2 * std::numbers::pi * scales_.dominant_frequency, interval(reference_));
  return errors;
}

ReferenceNorms probe_norms(Trajectory reference, const Named<Probe>& probes, std::vector<FollowedQuantity> quantities) {
  std::vector<ProbePoint> points;
  for (const auto& [name, probe] : probes) {
    const int first = 3 * static_cast<int>(points.size());
    points.push_back({name, {first, first + 1, first + 2}});
  }
  const double share = 1 / static_cast<double>(points.size());
  const auto mean = [share](const Eigen::MatrixXd& x) -> Eigen::MatrixXd { return share * x; };
  return {mean, std::move(reference), points, std::move(quantities)};
}

}  // namespace orthodyn
