#include "lib/study/quantities/mode_matching.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/spelling.h"
#include "lib/fem/fem_model.h"
#include "lib/mesh/mesh_point.h"
#include "lib/study/quantities/assignment.h"

namespace orthodyn {

namespace {

constexpr double kOutOfBand = std::numeric_limits<double>::infinity();

Vec3 point(const ModeMatching& measured, std::size_t number) { return Vec3(&measured.points[3 * number]); }

std::size_t point_count(const ModeMatching& measured) { return measured.points.size() / 3; }

// Indices of the frequencies that were measured.
std::vector<std::size_t> rows_of(const ModeMatching& measured) {
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < measured.frequencies.size(); ++k)
    if (std::isfinite(measured.frequencies[k])) rows.push_back(k);
  return rows;
}

double relative_difference(double measured, double computed) { return std::abs(computed - measured) / measured; }

// The weight of the frequency beside a MAC: it decides between shapes that are equal at the points.
double preference(double measured, double computed) {
  constexpr double kWeight = 0.01;
  return kWeight * std::min(relative_difference(measured, computed), 1.0);
}

// Whether a mode may be taken for the measured one: its frequency is within a factor of two.
bool is_plausible(double measured, double computed) { return computed < 2 * measured && measured < 2 * computed; }

// Displacement along the direction at each point, by mode; and the largest displacement of each mode.
struct ShapesAtPoints {
  Eigen::MatrixXd values;
  std::vector<double> largest;
};

ShapesAtPoints shapes_at_points(const ModeMatching& measured, const Modes& modes, const FemModel& model,
                                const State& about) {
  const auto points = static_cast<Eigen::Index>(point_count(measured));
  std::vector<MeshPoint> places;
  for (std::size_t p = 0; p < point_count(measured); ++p)
    places.push_back(mesh_point(model.parts().mesh, point(measured, p)));
  const Vec3 direction(measured.direction.data());
  const std::vector<double> before = model.evaluate("displacement", about);
  const Eigen::Map<const Eigen::Matrix3Xd> start(before.data(), 3, std::ssize(before) / 3);
  ShapesAtPoints out{Eigen::MatrixXd(points, std::ssize(modes.modes) - modes.zeros), {}};
  for (Eigen::Index k = 0; k < out.values.cols(); ++k) {
    const Vector& shape = modes.modes[static_cast<std::size_t>(k + modes.zeros)].shape;
    const std::vector<double> moved = model.evaluate("displacement", {about.t, about.q + shape, about.v});
    const Eigen::Matrix3Xd u = Eigen::Map<const Eigen::Matrix3Xd>(moved.data(), 3, start.cols()) - start;
    out.largest.push_back(u.colwise().norm().maxCoeff());
    for (Eigen::Index p = 0; p < points; ++p) {
      Vec3 at = Vec3::Zero();
      for (const auto& [node, weight] : places[static_cast<std::size_t>(p)].nodes) at += weight * u.col(node);
      out.values(p, k) = direction.dot(at);
    }
  }
  return out;
}

// Reason why no ascending assignment exists: the first measured frequency that has no mode within the band, or whose
// modes all belong to lower ones.
std::string reason(const ModeMatching& measured, const std::vector<std::size_t>& rows, const Eigen::MatrixXd& costs,
                   const std::vector<double>& computed) {
  Eigen::Index row = 0;
  while (row + 1 < costs.rows() && smallest_ascending_assignment(costs.topRows(row + 1))) ++row;
  const std::size_t number = rows[static_cast<std::size_t>(row)];
  const double frequency = measured.frequencies[number];
  if (costs.cols() > 0 && std::isfinite(costs.row(row).minCoeff()))
    return fmt::format(
        "measured frequency {} ({:.6g} Hz) has no computed mode of its own: all modes within {:.3g} % of it belong to "
        "lower measured frequencies",
        number + 1, frequency, 100 * measured.band);
  const auto nearest =
      std::ranges::min_element(computed, {}, [&](double f) { return relative_difference(frequency, f); });
  const std::string found = nearest == computed.end() ? "the model has no elastic modes"
                                                      : fmt::format("the nearest one is mode {}, {:.6g} Hz",
                                                                    nearest - computed.begin() + 1, *nearest);
  return fmt::format(
      "no computed mode is within {:.3g} % of measured frequency {} ({:.6g} Hz); {}. Start nearer to "
      "the measurement, give a wider 'band', or 'shapes'",
      100 * measured.band, number + 1, frequency, found);
}

}  // namespace

double ModeMatching::highest() const {
  double out = 0;
  for (const double frequency : frequencies)
    if (frequency > out) out = frequency;
  return (1 + band) * out;
}

double modal_assurance(const std::vector<double>& measured, const Eigen::VectorXd& computed) {
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t p = 0; p < measured.size(); ++p) {
    const double a = measured[p], b = computed[static_cast<Eigen::Index>(p)];
    if (std::isnan(a)) continue;
    ab += a * b, aa += a * a, bb += b * b;
  }
  const double product = aa * bb;
  return product > 0 ? ab / aa * (ab / bb) : 0;
}

Eigen::MatrixXd modal_assurances(const ModeMatching& measured, const Eigen::MatrixXd& at_points,
                                 const std::vector<double>& largest) {
  constexpr double kZero = 1e-6;  // of an amplitude, over the mode's largest displacement
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(std::ssize(measured.shapes), at_points.cols());
  for (const std::size_t row : rows_of(measured))
    for (Eigen::Index k = 0; k < at_points.cols(); ++k)
      if (at_points.col(k).lpNorm<Eigen::Infinity>() > kZero * largest[static_cast<std::size_t>(k)])
        out(static_cast<Eigen::Index>(row), k) = modal_assurance(measured.shapes[row], at_points.col(k));
  return out;
}

std::vector<ModeMatch> match_by_shape(const ModeMatching& measured, const std::vector<double>& computed,
                                      const Eigen::MatrixXd& assurances) {
  std::vector<ModeMatch> out(measured.frequencies.size());
  const std::vector<std::size_t> rows = rows_of(measured);
  if (rows.size() > computed.size()) {
    for (const std::size_t row : rows)
      out[row].failure =
          fmt::format("the model has {}, fewer than the {}", counted(std::ssize(computed), "elastic mode"),
                      rows.size() == 1 ? "measured frequency" : fmt::format("{} measured frequencies", rows.size()));
    return out;
  }
  Eigen::MatrixXd gains(std::ssize(rows), std::ssize(computed));
  for (Eigen::Index i = 0; i < gains.rows(); ++i)
    for (Eigen::Index k = 0; k < gains.cols(); ++k) {
      const std::size_t row = rows[static_cast<std::size_t>(i)];
      gains(i, k) = assurances(static_cast<Eigen::Index>(row), k) -
                    preference(measured.frequencies[row], computed[static_cast<std::size_t>(k)]);
    }
  const auto columns = largest_assignment(gains);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ModeMatch& match = out[rows[i]];
    const auto own = assurances.row(static_cast<Eigen::Index>(rows[i]));
    match.mode = static_cast<int>(columns[i]) + 1;
    match.mac = own[columns[i]];
    for (Eigen::Index k = 0; k < own.size(); ++k)
      if (k != columns[i] && is_plausible(measured.frequencies[rows[i]], computed[static_cast<std::size_t>(k)]) &&
          !(own[k] <= match.next_mac))
        match.next = static_cast<int>(k) + 1, match.next_mac = own[k];
  }
  return out;
}

std::vector<ModeMatch> match_by_frequency(const ModeMatching& measured, const std::vector<double>& computed) {
  std::vector<ModeMatch> out(measured.frequencies.size());
  const std::vector<std::size_t> rows = rows_of(measured);
  Eigen::MatrixXd costs(std::ssize(rows), std::ssize(computed));
  for (Eigen::Index i = 0; i < costs.rows(); ++i)
    for (Eigen::Index k = 0; k < costs.cols(); ++k) {
      const double difference = relative_difference(measured.frequencies[rows[static_cast<std::size_t>(i)]],
                                                    computed[static_cast<std::size_t>(k)]);
      costs(i, k) = difference <= measured.band ? difference * difference : kOutOfBand;
    }
  const auto columns = smallest_ascending_assignment(costs);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (columns) out[rows[i]].mode = static_cast<int>((*columns)[i]) + 1;
    else out[rows[i]].failure = reason(measured, rows, costs, computed);
  }
  return out;
}

std::vector<ModeMatch> match_modes(const ModeMatching& measured, const Modes& modes, const FemModel& model,
                                   const State& about) {
  std::vector<double> computed;
  for (auto k = static_cast<std::size_t>(modes.zeros); k < modes.modes.size(); ++k)
    computed.push_back(modes.modes[k].frequency());
  if (!measured.is_by_shape()) return match_by_frequency(measured, computed);
  const ShapesAtPoints at = shapes_at_points(measured, modes, model, about);
  return match_by_shape(measured, computed, modal_assurances(measured, at.values, at.largest));
}

std::vector<double> distances_from_body(const ModeMatching& measured, const FemModel& model) {
  const Mesh& mesh = model.parts().mesh;
  std::vector<double> out;
  for (std::size_t p = 0; p < point_count(measured); ++p) {
    Vec3 nearest = Vec3::Zero();
    for (const auto& [node, weight] : mesh_point(mesh, point(measured, p)).nodes) nearest += weight * mesh.node(node);
    out.push_back((nearest - point(measured, p)).norm());
  }
  return out;
}

double accepted_distance(const FemModel& model) {
  constexpr double kNear = 0.02;
  return kNear * bounding_box(model.parts().mesh).size().norm();
}

}  // namespace orthodyn
