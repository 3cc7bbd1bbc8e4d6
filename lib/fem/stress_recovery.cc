#include "lib/fem/stress_recovery.h"

#include <algorithm>
#include <cmath>

#include "lib/core/symmetric_eigen.h"
#include "lib/material/stiffness.h"

namespace orthodyn {

namespace {

// Of the normal equations' eigenvalues: smaller ones are of polynomials that the points hardly tell from others.
constexpr double kSmallest = 1e-4;
constexpr int kPointsPerCoefficient = 4;
constexpr int kMostRings = 3;

// Beside the constant.
int coefficients(int degree) { return degree == 1 ? 3 : 9; }

// x, y, z and for degree 2 their products.
Vector monomials(const Vec3& x, int degree) {
  Vector m(coefficients(degree));
  m.head<3>() = x;
  if (degree == 2) m.tail<6>() << x[0] * x[0], x[1] * x[1], x[2] * x[2], x[0] * x[1], x[1] * x[2], x[2] * x[0];
  return m;
}

// The elements at each node.
class Neighbours {
 public:
  Neighbours(const Cells& cells, std::size_t nodes) : cells_(cells), at_(nodes), mark_(cells.size(), -1) {
    for (std::size_t k = 0; k < cells.size(); ++k)
      for (const int node : cells[k]) at_[static_cast<std::size_t>(node)].push_back(static_cast<int>(k));
  }

  // Those around a node.
  std::vector<int> patch(int node) {
    std::vector<int> all;
    add(node, node, all);
    return all;
  }
  // With those beside the last patch. False if there are no more.
  bool grow(int node, std::vector<int>& patch) {
    const std::size_t size = patch.size();
    for (std::size_t i = 0; i < size; ++i)
      for (const int other : cells_[static_cast<std::size_t>(patch[i])]) add(node, other, patch);
    return patch.size() > size;
  }

 private:
  void add(int centre, int node, std::vector<int>& patch) {
    for (const int k : at_[static_cast<std::size_t>(node)]) {
      int& mark = mark_[static_cast<std::size_t>(k)];
      if (mark == centre) continue;
      mark = centre;
      patch.push_back(k);
    }
  }

  const Cells& cells_;
  std::vector<std::vector<int>> at_;
  std::vector<int> mark_;  // of each element the last patch that it is in
};

struct Fit {
  Vector weights;    // with which the values at the points give the fitted polynomial's at the centre
  bool determined;   // by enough points, which tell all polynomials apart
};

// Around the mean of the values, so that constants are met where the points are too few for more.
Fit fit(const std::vector<Vec3>& points, const Vec3& centre, int degree) {
  const auto count = static_cast<Eigen::Index>(points.size());
  double radius = 0;
  for (const Vec3& x : points) radius = std::max(radius, (x - centre).norm());
  Eigen::MatrixXd A(count, coefficients(degree));
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    A.row(i) = monomials((points[static_cast<std::size_t>(i)] - centre) / radius, degree).transpose();
  const Vector mean = A.colwise().mean();
  A.rowwise() -= mean.transpose();
  const auto pairs = symmetric_eigenpairs<Eigen::Dynamic>(Eigen::MatrixXd(A.transpose() * A));
  const double smallest = kSmallest * pairs.values[A.cols() - 1];
  Vector to_centre = Vector::Zero(A.cols());  // of the pseudo-inverse of A^T A, times what the monomials are there
  for (Eigen::Index i = 0; i < A.cols(); ++i)
    if (pairs.values[i] > smallest)
      to_centre -= pairs.vectors.col(i).dot(mean) / pairs.values[i] * pairs.vectors.col(i);
  return {(A * to_centre).array() + 1.0 / static_cast<double>(count),
          pairs.values[0] > smallest && count >= kPointsPerCoefficient * (A.cols() + 1)};
}

// Stress in the axes of space at rest, Pa, from the strain in material axes.
Vec6 stress_at_rest(const Mat6& C, const Mat3& strain, const Mat3& axes) {
  const Vec6 e = (Vec6() << strain.diagonal(), 2 * strain(0, 1), 2 * strain(1, 2), 2 * strain(2, 0)).finished();
  return stress_rotation(axes) * (C * e);
}

SixColumns at_points(const ElasticTerm& term, const std::function<Vec6(int k, int point)>& value) {
  SixColumns out(term.size() * term.num_points(), 6);
  for (int k = 0; k < term.size(); ++k)
    for (int p = 0; p < term.num_points(); ++p) out.row(k * term.num_points() + p) = value(k, p).transpose();
  return out;
}

// Mean over an element of d : C^-1 : d / 2 for d with the values `rows` at its nodes, J/m^3.
double energy_of_stress(const Eigen::MatrixXd& shares, const Mat6& compliance, const SixColumns& rows) {
  return 0.5 * (rows.transpose() * shares * rows * compliance).trace();
}

RegionMeshError mesh_error(const ElementMesh& mesh, const ElasticTerm& term, const RegionRecovery& recovery,
                           const NodalState& s) {
  const Mat6 C = term.stiffness(), material_compliance = C.inverse();
  const SixColumns computed = at_points(term, [&](int k, int p) {
    return stress_at_rest(C, term.observe_point(k, p, s).strain, term.axes_at_rest(k, p));
  });
  const SixColumns recovered = recovery.at_nodes(computed);
  const Eigen::MatrixXd extrapolation = mesh.type.points_to_nodes();
  RegionMeshError out{Vector(term.size()), Vector(term.size()), 0};
  // As shares of the volume it is the same for all elements with straight edges.
  const auto volume = [&](int k) {
    return mesh.type.lumped_mass(mesh.positions(static_cast<std::size_t>(term.cell(k))), 1).sum();
  };
  const Eigen::MatrixXd shares =
      mesh.type.consistent_mass(mesh.positions(static_cast<std::size_t>(term.cell(0))), 1) / volume(0);
  for (int k = 0; k < term.size(); ++k) {
    // C^-1 in space: with sigma' = K sigma it is K C^-1' K^T for K that of the inverse rotation.
    const Mat6 to_material = stress_rotation(term.axes_at_rest(k, 0).transpose());
    const Mat6 compliance = to_material.transpose() * material_compliance * to_material;
    const SixColumns own = extrapolation * computed.middleRows(k * term.num_points(), term.num_points());
    const auto nodes = recovery.cells()[static_cast<std::size_t>(k)];
    SixColumns difference = -own;
    for (std::size_t a = 0; a < nodes.size(); ++a)
      difference.row(static_cast<Eigen::Index>(a)) += recovered.row(nodes[a]);
    out.volume[k] = volume(k);
    out.error[k] = out.volume[k] * energy_of_stress(shares, compliance, difference);
    out.energy += out.volume[k] * energy_of_stress(shares, compliance, own);
  }
  return out;
}

}  // namespace

RegionRecovery::RegionRecovery(const ElementMesh& mesh, const ElasticTerm& term) {
  std::vector<int> row_of(mesh.nodes.size(), -1), all;
  for (int k = 0; k < term.size(); ++k)
    for (const int node : mesh.cells[static_cast<std::size_t>(term.cell(k))]) {
      int& row = row_of[static_cast<std::size_t>(node)];
      if (row < 0) {
        row = static_cast<int>(nodes_.size());
        nodes_.push_back(node);
      }
      all.push_back(row);
    }
  cells_ = Cells(mesh.cells.nodes_per_cell(), std::move(all));

  const int per_element = term.num_points();
  std::vector<Vec3> places;
  for (int k = 0; k < term.size(); ++k) {
    const auto points = mesh.type.points(mesh.positions(static_cast<std::size_t>(term.cell(k))));
    for (int p = 0; p < per_element; ++p) places.emplace_back(points.col(p));
  }
  const int degree = mesh.type.degree();
  Neighbours neighbours(cells_, nodes_.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < static_cast<int>(nodes_.size()); ++row) {
    const Vec3& centre = mesh.nodes[static_cast<std::size_t>(nodes_[static_cast<std::size_t>(row)])];
    std::vector<int> patch = neighbours.patch(row), points;
    Vector weights;
    for (int ring = 0;; ++ring) {
      std::vector<Vec3> at;
      points.clear();
      for (const int k : patch)
        for (int p = 0; p < per_element; ++p) {
          points.push_back(k * per_element + p);
          at.push_back(places[static_cast<std::size_t>(points.back())]);
        }
      Fit found = fit(at, centre, degree);
      weights = std::move(found.weights);
      if (found.determined || ring == kMostRings || !neighbours.grow(row, patch)) break;
    }
    for (std::size_t i = 0; i < points.size(); ++i)
      entries.emplace_back(row, points[i], weights[static_cast<Eigen::Index>(i)]);
  }
  weights_.resize(static_cast<Eigen::Index>(nodes_.size()), static_cast<Eigen::Index>(places.size()));
  weights_.setFromTriplets(entries.begin(), entries.end());
}

const std::vector<RegionRecovery>& StressRecovery::regions() const {
  std::call_once(once_, [&] {
    const ElementMesh mesh(mesh_);
    for (const auto& term : terms_) regions_.emplace_back(mesh, *term);
  });
  return regions_;
}

Eigen::Matrix<double, 6, Eigen::Dynamic> StressRecovery::at_nodes(const NodalState& s, const Seen& seen) const {
  Eigen::Matrix<double, 6, Eigen::Dynamic> sum = Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, s.x.cols());
  std::vector<int> count(static_cast<std::size_t>(s.x.cols()), 0);
  for (std::size_t r = 0; r < terms_.size(); ++r) {
    const ElasticTerm& term = *terms_[r];
    const RegionRecovery& recovery = regions()[r];
    const SixColumns values = recovery.at_nodes(
        at_points(term, [&](int k, int p) { return seen(term.observe_point(k, p, s)); }));
    for (std::size_t i = 0; i < recovery.nodes().size(); ++i) {
      const int node = recovery.nodes()[i];
      sum.col(node) += values.row(static_cast<Eigen::Index>(i)).transpose();
      ++count[static_cast<std::size_t>(node)];
    }
  }
  for (Eigen::Index i = 0; i < sum.cols(); ++i) sum.col(i) /= std::max(count[static_cast<std::size_t>(i)], 1);
  return sum;
}

std::vector<RegionMeshError> StressRecovery::mesh_errors(const NodalState& s) const {
  const ElementMesh mesh(mesh_);
  std::vector<RegionMeshError> all;
  for (std::size_t r = 0; r < terms_.size(); ++r) all.push_back(mesh_error(mesh, *terms_[r], regions()[r], s));
  return all;
}

}  // namespace orthodyn
