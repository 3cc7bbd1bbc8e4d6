// Isoparametric elements: functions derived from a reference element by the map X(xi) = sum_a X_a N_a(xi).
//
// A reference element R is a struct with static members:
//
//   kShape, kNodes, kPoints
//   nodes()             natural coordinates of the nodes, one per column
//   shape(xi)           the shape functions N_a
//   shape_slopes(xi)    their derivatives dN_a/dxi_i
//   points()            quadrature points of the stiffness
//   mass_points()       quadrature points of the mass
//   interpolation(xi)   kPoints polynomials, a basis for interpolation between points()
//
// Isoparametric<R> then has all functions of the concept Element. Volume and mass are exact where mass_points()
// integrate det J exactly, and the consistent mass where they integrate N_a N_b det J.
#pragma once

#include <vector>

#include "lib/element/element.h"
#include "lib/element/quadrature.h"

namespace orthodyn {

// Natural coordinates of a quadratic cell's nodes, one per column, from those of its corners.
template <int kNodes>
ElementNodes<kNodes> nodes_from_corners(CellShape shape, const Eigen::Matrix3Xd& corners) {
  ElementNodes<kNodes> all;
  all.leftCols(corners.cols()) = corners;
  Eigen::Index node = corners.cols();
  for (const std::vector<int>& middle : topology(shape).middles)
    all.col(node++) = corners(Eigen::all, middle).rowwise().mean();
  return all;
}

template <class R>
struct Isoparametric : R {
  static constexpr int kNodes = R::kNodes, kPoints = R::kPoints;

  using Place = Vec3;  // natural coordinates
  using Values = Eigen::Matrix<double, kNodes, 1>;
  using Slopes = Eigen::Matrix<double, kNodes, 3>;

  static Place place(int point) { return R::points()[static_cast<std::size_t>(point)].place; }

  // dX/dxi, m.
  static Mat3 jacobian(const NodeDifferences<kNodes>& rest, const Place& xi) {
    return rest * R::shape_slopes(xi).template bottomRows<kNodes - 1>();
  }

  // Natural coordinates at which validate() checks the Jacobian: nodes, points() and mass_points().
  static const std::vector<Place>& checked_places() {
    static const std::vector<Place> all = [] {
      std::vector<Place> places;
      for (int a = 0; a < kNodes; ++a) places.push_back(R::nodes().col(a));
      for (const QuadraturePoint& at : R::points()) places.push_back(at.place);
      for (const QuadraturePoint& at : R::mass_points()) places.push_back(at.place);
      return places;
    }();
    return all;
  }

  static ElementPoint<kNodes> point(int p, const NodeDifferences<kNodes>& rest, const Mat3& Q) {
    static const std::vector<Sample> samples = samples_at(R::points());
    return point_of(samples[static_cast<std::size_t>(p)], rest, Q);
  }
  static ElementPoint<kNodes> point(const QuadraturePoint& at, const NodeDifferences<kNodes>& rest, const Mat3& Q) {
    return point_of(sample_at(at), rest, Q);
  }

  // dN_a/dxi of the nodes 1, 2, ...
  static Eigen::Matrix<double, kNodes - 1, 3> slopes(const QuadraturePoint& at) {
    return R::shape_slopes(at.place).template bottomRows<kNodes - 1>();
  }

  static Vec3 place_of(int p, const ElementNodes<kNodes>& X) { return X * R::shape(place(p)); }

  static Eigen::Matrix<double, kNodes, kPoints> points_to_nodes() {
    return extrapolation(R::points(), &R::interpolation);
  }

  // Matrix (nodes x points) that extrapolates values at `points` to the nodes. `polynomials`: one for each point.
  template <class Polynomials>
  static Eigen::MatrixXd extrapolation(const std::vector<QuadraturePoint>& points, Polynomials&& polynomials) {
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd at_nodes(kNodes, n), at_points(n, n);
    for (int a = 0; a < kNodes; ++a) at_nodes.row(a) = polynomials(R::nodes().col(a)).transpose();
    for (Eigen::Index p = 0; p < n; ++p)
      at_points.row(p) = polynomials(points[static_cast<std::size_t>(p)].place).transpose();
    return extrapolation_matrix(at_nodes, at_points);
  }

  // own_rule(): the points of R. part_of_rule(): `rule` mapped to begin < t < end, t the third natural coordinate in
  // [-1, 1].
  static IntegrationRule own_rule() { return {R::points(), R::nodes(), points_to_nodes()}; }
  static IntegrationRule part_of_rule(IntegrationRule rule, double begin, double end) {
    const double scale = (end - begin) / 2, centre = (begin + end) / 2;
    for (QuadraturePoint& at : rule.points) {
      at.place[2] = centre + scale * at.place[2];
      at.weight *= scale;
    }
    for (double& t : rule.nodes.row(2)) t = t == -1 ? begin : t == 1 ? end : centre + scale * t;
    return rule;
  }

  static double mass(const ElementNodes<kNodes>& X, double density) {
    const NodeDifferences<kNodes> rest = differences<kNodes>(X);
    double volume = 0;
    for (const Sample& at : mass_samples()) volume += at.weight * Mat3(rest * at.slopes).determinant();
    return density * volume;
  }

  static Eigen::Matrix<double, kNodes, kNodes> consistent_mass(const ElementNodes<kNodes>& X, double density) {
    const NodeDifferences<kNodes> rest = differences<kNodes>(X);
    Eigen::Matrix<double, kNodes, kNodes> M = Eigen::Matrix<double, kNodes, kNodes>::Zero();
    for (const Sample& at : mass_samples())
      M += density * at.weight * Mat3(rest * at.slopes).determinant() * at.N * at.N.transpose();
    return M;
  }

 private:
  struct Sample {
    Values N;
    Eigen::Matrix<double, kNodes - 1, 3> slopes;  // of nodes 1, 2, ...
    double weight;
  };

  static Sample sample_at(const QuadraturePoint& at) { return {R::shape(at.place), slopes(at), at.weight}; }
  static std::vector<Sample> samples_at(const std::vector<QuadraturePoint>& points) {
    std::vector<Sample> samples;
    for (const QuadraturePoint& at : points) samples.push_back(sample_at(at));
    return samples;
  }

  static ElementPoint<kNodes> point_of(const Sample& at, const NodeDifferences<kNodes>& rest, const Mat3& Q) {
    const Mat3 J = rest * at.slopes;
    return {at.slopes * J.inverse() * Q, at.weight * J.determinant()};
  }

  static const std::vector<Sample>& mass_samples() {
    static const std::vector<Sample> all = samples_at(R::mass_points());
    return all;
  }
};

}  // namespace orthodyn
