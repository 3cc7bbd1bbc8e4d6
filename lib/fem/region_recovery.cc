#include "lib/fem/region_recovery.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/core/symmetric_eigen.h"

namespace orthodyn {

namespace {

// Smallest usable eigenvalue of the normal equations, relative to the largest. The points do not determine polynomials
// with smaller eigenvalues.
constexpr double kSmallest = 1e-4;
// Likewise for the 2 x 2 x 2 points of hexahedra, where stresses are so accurate that the few points at the surface are
// extrapolated rather than supplemented by those of neighbours: squares across a single layer are left out.
constexpr double kSmallestOfHexahedra = 0.03;
constexpr Eigen::Index kBilinear = 6;  // coefficients that one hexahedron determines: x, y, z, xy, yz, zx
constexpr int kPointsPerCoefficient = 4;
constexpr int kPointsInLayers =
    3;  // likewise, of points in layers, which lack full rank: the four hexahedra at a corner
constexpr int kMostRings = 3;
constexpr double kFlat = 1e-6;  // smallest thickness of a patch relative to its width

// Number of monomials besides the constant.
constexpr int kLinear = 3, kQuadratic = 9;
int coefficients(int degree) { return degree == 1 ? kLinear : kQuadratic; }

// The monomials x, y, z, and for degree 2 also their products.
template <int kCoefficients>
Eigen::Matrix<double, kCoefficients, 1> monomials(const Vec3& x) {
  Eigen::Matrix<double, kCoefficients, 1> m;
  m.template head<3>() = x;
  if constexpr (kCoefficients == kQuadratic)
    m.template tail<6>() << x[0] * x[0], x[1] * x[1], x[2] * x[2], x[0] * x[1], x[1] * x[2], x[2] * x[0];
  return m;
}
Vector monomials(const Vec3& x, int degree) {
  return degree == 1 ? Vector(monomials<kLinear>(x)) : Vector(monomials<kQuadratic>(x));
}

// Patches of elements around corner nodes.
class RegionNeighbours {
 public:
  RegionNeighbours(const Cells& cells, std::size_t nodes) : cells_(cells), at_(nodes), mark_(cells.size(), -1) {
    for (std::size_t k = 0; k < cells.size(); ++k)
      for (const int node : cells.corners(k)) at_[static_cast<std::size_t>(node)].push_back(static_cast<int>(k));
  }

  // Elements at a corner; empty for other nodes.
  std::vector<int> patch(int node) {
    std::vector<int> all;
    add(node, node, all);
    return all;
  }
  // Adds the neighbours of the patch around `node`. Returns false if there are none.
  bool grow(int node, std::vector<int>& patch) {
    const std::size_t size = patch.size();
    for (std::size_t i = 0; i < size; ++i)
      for (const int other : cells_.corners(static_cast<std::size_t>(patch[i]))) add(node, other, patch);
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
  std::vector<int> mark_;  // per element: the last patch that contains it
};

// Monomials at the given places, one row each.
Eigen::MatrixXd monomials_at(const Eigen::Matrix3Xd& places, const Vec3& centre, const Mat3& to_patch, int degree) {
  Eigen::MatrixXd A(places.cols(), coefficients(degree));
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    A.row(i) = monomials(to_patch * (places.col(i) - centre), degree).transpose();
  return A;
}

Mat3 principal_axes(const Eigen::Matrix3Xd& places) {
  const Eigen::Matrix3Xd relative = places.colwise() - Vec3(places.rowwise().mean());
  const auto pairs =
      symmetric_eigenpairs<3>(Mat3(relative * relative.transpose() / static_cast<double>(places.cols())));
  const double largest = pairs.values[2];
  Vec3 spread;
  for (int i = 0; i < 3; ++i) spread[i] = std::sqrt(std::max(pairs.values[i], kFlat * kFlat * largest));
  return spread.cwiseInverse().asDiagonal() * pairs.vectors.transpose();
}

struct Fit {
  PatchFit patch;
  Eigen::Index rank;  // number of coefficients that the points determine
  bool has_enough_points;

  bool has_full_rank() const { return rank == patch.inverse.rows(); }
};

Fit fit(const Eigen::Matrix3Xd& places, const Vec3& centre, int degree, double smallest_share = kSmallest) {
  const Mat3 to_patch = principal_axes(places);
  Eigen::MatrixXd A = monomials_at(places, centre, to_patch, degree);
  const Vector means = A.colwise().mean();
  A.rowwise() -= means.transpose();
  const auto pairs = symmetric_eigenpairs<Eigen::Dynamic>(Eigen::MatrixXd(A.transpose() * A));
  const double smallest = smallest_share * pairs.values[A.cols() - 1];
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(A.cols(), A.cols());
  Eigen::Index rank = 0;
  for (Eigen::Index i = 0; i < A.cols(); ++i)
    if (pairs.values[i] > smallest) {
      inverse += pairs.vectors.col(i) / pairs.values[i] * pairs.vectors.col(i).transpose();
      ++rank;
    }
  return {{centre, to_patch, means, std::move(inverse)},
          rank,
          A.rows() >= (rank < A.cols() ? kPointsInLayers : kPointsPerCoefficient) * (rank + 1)};
}

// Points in two layers do not tell z from z^2. About their mean z^2 is a constant, so that the fit is linear in z.
Vec3 mean_of(const Eigen::Matrix3Xd& places) { return places.rowwise().mean(); }

}  // namespace

RegionRecovery::RegionRecovery(const ElementMesh& mesh, const std::vector<int>& cells, const ElementType& type)
    : per_element_(type.num_points()) {
  std::vector<int> row_of(mesh.nodes.size(), -1), rows;
  for (const int cell : cells) {
    rows.clear();
    for (const int node : mesh.cells[static_cast<std::size_t>(cell)]) {
      int& row = row_of[static_cast<std::size_t>(node)];
      if (row < 0) {
        row = static_cast<int>(nodes_.size());
        nodes_.push_back(node);
      }
      rows.push_back(row);
    }
    cells_.add(mesh.cells.shape(static_cast<std::size_t>(cell)), rows);
  }
  if (cells.empty()) return;
  degree_ = type.degree();
  places_.resize(3, per_element_ * static_cast<Eigen::Index>(cells.size()));
  node_places_.resize(3, static_cast<Eigen::Index>(nodes_.size()));
  inside_.resize(nodes_.size());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const ElementType::Nodes X = mesh.positions(static_cast<std::size_t>(cells[k])), part = type.part(X);
    places_.middleCols(per_element_ * static_cast<Eigen::Index>(k), per_element_) = type.points(X);
    for (Eigen::Index a = 0; a < part.cols(); ++a) {
      const int row = cells_[k][static_cast<std::size_t>(a)];
      node_places_.col(row) = part.col(a);
      inside_[static_cast<std::size_t>(row)] = type.holds(static_cast<int>(a));
    }
  }

  const bool has_superconvergent_points = type.shape() == CellShape::hex20 && per_element_ == 8;
  RegionNeighbours neighbours(cells_, nodes_.size());
  std::vector<int> patch_of(nodes_.size(), -1);
  for (int row = 0; row < static_cast<int>(nodes_.size()); ++row) {
    std::vector<int> elements = neighbours.patch(row);
    if (elements.empty()) continue;
    const Vec3 centre = node_places_.col(row);
    Fit found = fit(places_of(elements), centre, degree_);
    bool is_enough = false;
    if (has_superconvergent_points) {
      Fit own = fit(places_of(elements), mean_of(places_of(elements)), degree_, kSmallestOfHexahedra);
      is_enough = own.rank >= kBilinear;
      if (is_enough) found = std::move(own);
    }
    for (int ring = 0; ring < kMostRings && !is_enough && !(found.has_full_rank() && found.has_enough_points); ++ring) {
      std::vector<int> larger = elements;
      if (!neighbours.grow(row, larger)) break;
      Fit wider = fit(places_of(larger), centre, degree_);
      // Neighbours do not help where all points lie in two layers; a wider patch would only be less accurate.
      if (found.has_enough_points && wider.rank == found.rank) break;
      elements = std::move(larger);
      found = std::move(wider);
    }
    if (!is_enough && !found.has_full_rank()) found = fit(places_of(elements), mean_of(places_of(elements)), degree_);
    patch_of[static_cast<std::size_t>(row)] = static_cast<int>(patches_.size());
    elements.shrink_to_fit();
    patches_.push_back({row, std::move(elements), std::move(found.patch), {}});
  }
  patches_.shrink_to_fit();
  add_middles(patch_of);
}

void RegionRecovery::add_middles(const std::vector<int>& patch_of) {
  std::vector<bool> is_known(nodes_.size(), false);
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    const CellTopology& cell = topology(cells_.shape(k));
    for (std::size_t m = 0; m < cell.middles.size(); ++m) {
      const int middle = cells_[k][static_cast<std::size_t>(cell.corners) + m];
      if (is_known[static_cast<std::size_t>(middle)]) continue;
      is_known[static_cast<std::size_t>(middle)] = true;
      const double share = 1.0 / static_cast<double>(cell.middles[m].size());
      for (const int corner : cell.middles[m]) {
        const int row = cells_[k][static_cast<std::size_t>(corner)];
        patches_[static_cast<std::size_t>(patch_of[static_cast<std::size_t>(row)])].middles.push_back({middle, share});
      }
    }
  }
}

Eigen::Matrix3Xd RegionRecovery::places_of(const std::vector<int>& elements) const {
  Eigen::Matrix3Xd all(3, per_element_ * static_cast<Eigen::Index>(elements.size()));
  for (std::size_t i = 0; i < elements.size(); ++i)
    all.middleCols(per_element_ * static_cast<Eigen::Index>(i), per_element_) =
        places_.middleCols(per_element_ * elements[i], per_element_);
  return all;
}

SixColumns RegionRecovery::at_nodes(const SixColumns& at_points) const {
  return degree_ == 1 ? at_nodes_with<kLinear>(at_points) : at_nodes_with<kQuadratic>(at_points);
}

Vec6 RegionRecovery::at_node(int row, const AtPoint& at_point) const {
  return degree_ == 1 ? at_node_with<kLinear>(row, at_point) : at_node_with<kQuadratic>(row, at_point);
}

// Fits polynomials to values at the points of patches.
template <int kCoefficients>
class RegionRecovery::PatchSolver {
 public:
  using Row = Eigen::Matrix<double, 1, 6>;

  explicit PatchSolver(const RegionRecovery& region) : region_(region) {
    std::size_t most = 0;
    for (const Patch& patch : region.patches_) most = std::max(most, patch.elements.size());
    monomials_.resize(region.per_element_ * static_cast<Eigen::Index>(most), kCoefficients);
    values_.resize(monomials_.rows(), 6);
  }

  // `values`: of element k at its point p.
  template <class Values>
  void fit(const Patch& patch, Values&& values) {
    patch_ = &patch;
    Eigen::Index count = 0;
    for (const int k : patch.elements)
      for (int p = 0; p < region_.per_element_; ++p, ++count) {
        monomials_.row(count) = relative(region_.places_.col(region_.per_element_ * k + p));
        values_.row(count) = values(k, p);
      }
    mean_ = values_.topRows(count).colwise().mean();
    const Slopes moments = monomials_.topRows(count).transpose().lazyProduct(values_.topRows(count));
    slopes_ = patch.fit.inverse.topLeftCorner<kCoefficients, kCoefficients>().lazyProduct(moments);
  }

  // The polynomial at a node, an index into nodes().
  Row at(int row) const { return mean_ + relative(region_.node_places_.col(row)) * slopes_; }

 private:
  Eigen::Matrix<double, 1, kCoefficients> relative(const Vec3& place) const {
    const PatchFit& fit = patch_->fit;
    return (monomials<kCoefficients>(fit.to_patch * (place - fit.centre)) - fit.means.head<kCoefficients>())
        .transpose();
  }

  using Slopes = Eigen::Matrix<double, kCoefficients, 6>;
  const RegionRecovery& region_;
  const Patch* patch_ = nullptr;
  Eigen::Matrix<double, Eigen::Dynamic, kCoefficients>
      monomials_;  // one row per point, as many as the largest patch has
  Eigen::Matrix<double, Eigen::Dynamic, 6> values_;
  Row mean_;
  Slopes slopes_;
};

template <int kCoefficients>
SixColumns RegionRecovery::at_nodes_with(const SixColumns& at_points) const {
  SixColumns out = SixColumns::Zero(static_cast<Eigen::Index>(nodes_.size()), 6);
  PatchSolver<kCoefficients> solver(*this);
  for (const Patch& patch : patches_) {
    solver.fit(patch, [&](int k, int p) { return at_points.row(per_element_ * k + p); });
    out.row(patch.row) = solver.at(patch.row);
    for (const auto& [middle, share] : patch.middles) out.row(middle) += share * solver.at(middle);
  }
  return out;
}

template <int kCoefficients>
Vec6 RegionRecovery::at_node_with(int row, const AtPoint& at_point) const {
  Vec6 out = Vec6::Zero();
  PatchSolver<kCoefficients> solver(*this);
  for (const Patch& patch : patches_) {
    const bool is_centre = patch.row == row;
    const auto middle =
        std::find_if(patch.middles.begin(), patch.middles.end(), [&](const Middle& m) { return m.row == row; });
    if (!is_centre && middle == patch.middles.end()) continue;
    solver.fit(patch,
               [&](int k, int p) -> typename PatchSolver<kCoefficients>::Row { return at_point(k, p).transpose(); });
    out += (is_centre ? 1.0 : middle->share) * solver.at(row).transpose();
  }
  return out;
}

}  // namespace orthodyn
