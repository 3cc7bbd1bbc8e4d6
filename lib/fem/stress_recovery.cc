#include "lib/fem/stress_recovery.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "lib/core/symmetric_eigen.h"
#include "lib/material/stiffness.h"

namespace orthodyn {

namespace {

// Of the normal equations' eigenvalues: smaller ones are of polynomials that the points hardly tell from others.
constexpr double kSmallest = 1e-4;
constexpr int kPointsPerCoefficient = 4;
constexpr int kMostRings = 3;
constexpr double kFlat = 1e-6;       // thickness of a flat patch, of its width
constexpr double kSmallStep = 1e-6;  // of the body's smallest extent

// Beside the constant.
constexpr int kLinear = 3, kQuadratic = 9;
int coefficients(int degree) { return degree == 1 ? kLinear : kQuadratic; }

// x, y, z and for degree 2 their products.
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

// The elements at each corner.
class Neighbours {
 public:
  Neighbours(const Cells& cells, int corners, std::size_t nodes)
      : cells_(cells), corners_(static_cast<std::size_t>(corners)), at_(nodes), mark_(cells.size(), -1) {
    for (std::size_t k = 0; k < cells.size(); ++k)
      for (const int node : corners_of(k)) at_[static_cast<std::size_t>(node)].push_back(static_cast<int>(k));
  }

  // Those around a corner; none of a node that is no corner.
  std::vector<int> patch(int node) {
    std::vector<int> all;
    add(node, node, all);
    return all;
  }
  // With those beside the last patch. False if there are no more.
  bool grow(int node, std::vector<int>& patch) {
    const std::size_t size = patch.size();
    for (std::size_t i = 0; i < size; ++i)
      for (const int other : corners_of(static_cast<std::size_t>(patch[i]))) add(node, other, patch);
    return patch.size() > size;
  }

 private:
  std::span<const int> corners_of(std::size_t cell) const { return cells_[cell].first(corners_); }

  void add(int centre, int node, std::vector<int>& patch) {
    for (const int k : at_[static_cast<std::size_t>(node)]) {
      int& mark = mark_[static_cast<std::size_t>(k)];
      if (mark == centre) continue;
      mark = centre;
      patch.push_back(k);
    }
  }

  const Cells& cells_;
  std::size_t corners_;
  std::vector<std::vector<int>> at_;
  std::vector<int> mark_;  // of each element the last patch that it is in
};

// Places as the monomials take them, a row each.
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

// Fits, and says whether the points are enough, and tell all polynomials apart.
std::pair<PatchFit, bool> fit(const Eigen::Matrix3Xd& places, const Vec3& centre, int degree) {
  const Mat3 to_patch = principal_axes(places);
  Eigen::MatrixXd A = monomials_at(places, centre, to_patch, degree);
  const Vector means = A.colwise().mean();
  A.rowwise() -= means.transpose();
  const auto pairs = symmetric_eigenpairs<Eigen::Dynamic>(Eigen::MatrixXd(A.transpose() * A));
  const double smallest = kSmallest * pairs.values[A.cols() - 1];
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(A.cols(), A.cols());
  for (Eigen::Index i = 0; i < A.cols(); ++i)
    if (pairs.values[i] > smallest)
      inverse += pairs.vectors.col(i) / pairs.values[i] * pairs.vectors.col(i).transpose();
  const bool determined = pairs.values[0] > smallest && A.rows() >= kPointsPerCoefficient * (A.cols() + 1);
  return {{centre, to_patch, means, std::move(inverse)}, determined};
}

SixColumns at_points(const ElasticTerm& term, const std::function<Vec6(int k, int point)>& value) {
  SixColumns out(term.size() * term.num_points(), 6);
  for (int k = 0; k < term.size(); ++k)
    for (int p = 0; p < term.num_points(); ++p) out.row(k * term.num_points() + p) = value(k, p).transpose();
  return out;
}

// In the axes of space at rest, Pa.
SixColumns stresses(const ElasticTerm& term, const NodalState& s) {
  const Mat6 C = term.stiffness();
  const auto strains = term.strains(s);
  SixColumns out(strains.cols(), 6);
  for (Eigen::Index i = 0; i < strains.cols(); ++i) {
    const auto k = static_cast<int>(i / term.num_points()), p = static_cast<int>(i % term.num_points());
    out.row(i) = (stress_rotation(term.axes_at_rest(k, p)) * (C * strains.col(i))).transpose();
  }
  return out;
}

// Of one element, a row for each of its nodes or points.
constexpr int kMostNodes = ElementType::kMostNodes;
using ElementRows = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor, kMostNodes, 6>;
using ElementMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostNodes, kMostNodes>;

// Integrals over the elements of a term of products of stresses that are given at their nodes.
class EnergyOfStress {
 public:
  EnergyOfStress(const ElementMesh& mesh, const ElasticTerm& term)
      : mesh_(mesh), term_(term), compliance_(Mat6(term.stiffness().inverse())),
        shares_(mesh.type.consistent_mass(positions(0), 1) / volume(0)) {
    if (term.definition().axes.uniform()) in_space_ = compliance_in_space(0);
  }

  double volume(int k) const { return mesh_.type.lumped_mass(positions(k), 1).sum(); }

  // The mean of a : C^-1 : b / 2, J/m^3. As shares of the volume the integrals are the same for all elements with
  // straight edges.
  double density(int k, const ElementRows& a, const ElementRows& b) const {
    const Mat6 compliance = in_space_ ? *in_space_ : compliance_in_space(k);
    const ElementRows of_b = shares_.lazyProduct(b);
    return 0.5 * a.lazyProduct(compliance).cwiseProduct(of_b).sum();
  }

 private:
  // With sigma' = K sigma it is K C^-1' K^T for K that of the inverse rotation.
  Mat6 compliance_in_space(int k) const {
    const Mat6 to_material = stress_rotation(term_.axes_at_rest(k, 0).transpose());
    return to_material.transpose() * compliance_ * to_material;
  }

  ElementType::Nodes positions(int k) const { return mesh_.positions(static_cast<std::size_t>(term_.cell(k))); }

  const ElementMesh& mesh_;
  const ElasticTerm& term_;
  Mat6 compliance_;
  std::optional<Mat6> in_space_;  // where it is the same for all elements
  ElementMatrix shares_;
};

// Of the elements of a region, at their nodes: what was computed at their points, and the recovered less that.
class NodalStresses {
 public:
  NodalStresses(const ElementMesh& mesh, const RegionRecovery& recovery, const SixColumns& computed)
      : cells_(recovery.cells()), computed_(computed), recovered_(recovery.at_nodes(mesh, computed)),
        extrapolation_(mesh.type.points_to_nodes()) {}

  Eigen::Index nodes() const { return extrapolation_.rows(); }
  ElementRows computed(Eigen::Index k) const {
    const Eigen::Index points = extrapolation_.cols();
    return extrapolation_.lazyProduct(computed_.middleRows(points * k, points));
  }
  ElementRows misfit(Eigen::Index k, const ElementRows& computed) const {
    ElementRows out = -computed;
    const auto rows = cells_[static_cast<std::size_t>(k)];
    for (std::size_t a = 0; a < rows.size(); ++a) out.row(static_cast<Eigen::Index>(a)) += recovered_.row(rows[a]);
    return out;
  }

 private:
  const Cells& cells_;
  const SixColumns& computed_;
  SixColumns recovered_;
  ElementMatrix extrapolation_;
};

SixColumns misfit_of_region(const ElementMesh& mesh, const RegionRecovery& recovery, const SixColumns& computed) {
  const NodalStresses at(mesh, recovery, computed);
  SixColumns out(at.nodes() * static_cast<Eigen::Index>(recovery.cells().size()), 6);
  for (Eigen::Index k = 0; k < out.rows() / at.nodes(); ++k)
    out.middleRows(at.nodes() * k, at.nodes()) = at.misfit(k, at.computed(k));
  return out;
}

// `stress`: at the points of the region. `places`: of the term's elements in it.
RegionMeshError mesh_error(const ElementMesh& mesh, const ElasticTerm& term, const RegionRecovery& recovery,
                           const std::vector<int>& places, const SixColumns& stress) {
  RegionMeshError out{Vector(term.size()), Vector(term.size()), 0};
  if (term.size() == 0) return out;
  const NodalStresses at(mesh, recovery, stress);
  const EnergyOfStress energy(mesh, term);
  for (int k = 0; k < term.size(); ++k) {
    const int place = places[static_cast<std::size_t>(k)];
    const ElementRows computed = at.computed(place), misfit = at.misfit(place, computed);
    out.volume[k] = energy.volume(k);
    out.error[k] = out.volume[k] * energy.density(k, misfit, misfit);
    out.energy += out.volume[k] * energy.density(k, computed, computed);
  }
  return out;
}

}  // namespace

RegionRecovery::RegionRecovery(const ElementMesh& mesh, const std::vector<int>& cells, int num_points)
    : per_element_(num_points) {
  std::vector<int> row_of(mesh.nodes.size(), -1), all;
  all.reserve(cells.size() * static_cast<std::size_t>(mesh.cells.nodes_per_cell()));
  for (const int cell : cells)
    for (const int node : mesh.cells[static_cast<std::size_t>(cell)]) {
      int& row = row_of[static_cast<std::size_t>(node)];
      if (row < 0) {
        row = static_cast<int>(nodes_.size());
        nodes_.push_back(node);
      }
      all.push_back(row);
    }
  cells_ = Cells(mesh.cells.nodes_per_cell(), std::move(all));
  places_.resize(3, per_element_ * static_cast<Eigen::Index>(cells.size()));
  for (std::size_t k = 0; k < cells.size(); ++k)
    places_.middleCols(per_element_ * static_cast<Eigen::Index>(k), per_element_) =
        mesh.type.points(mesh.positions(static_cast<std::size_t>(cells[k])));

  const int degree = mesh.type.degree();
  Neighbours neighbours(cells_, mesh.type.num_corners(), nodes_.size());
  std::vector<int> patch_of(nodes_.size(), -1);
  for (int row = 0; row < static_cast<int>(nodes_.size()); ++row) {
    std::vector<int> elements = neighbours.patch(row);
    if (elements.empty()) continue;
    const Vec3& centre = mesh.nodes[static_cast<std::size_t>(nodes_[static_cast<std::size_t>(row)])];
    auto [found, determined] = fit(places_of(elements), centre, degree);
    for (int ring = 0; !determined && ring < kMostRings && neighbours.grow(row, elements); ++ring)
      std::tie(found, determined) = fit(places_of(elements), centre, degree);
    patch_of[static_cast<std::size_t>(row)] = static_cast<int>(patches_.size());
    elements.shrink_to_fit();
    patches_.push_back({row, std::move(elements), std::move(found), {}});
  }
  patches_.shrink_to_fit();
  add_middles(mesh.type, patch_of);
}

void RegionRecovery::add_middles(const ElementType& type, const std::vector<int>& patch_of) {
  std::vector<bool> is_known(nodes_.size(), false);
  for (std::size_t k = 0; k < cells_.size(); ++k)
    for (std::size_t e = 0; e < type.edges_with_middles().size(); ++e) {
      const int middle = cells_[k][static_cast<std::size_t>(type.num_corners()) + e];
      if (is_known[static_cast<std::size_t>(middle)]) continue;
      is_known[static_cast<std::size_t>(middle)] = true;
      for (const int corner : type.edges_with_middles()[e]) {
        const int row = cells_[k][static_cast<std::size_t>(corner)];
        patches_[static_cast<std::size_t>(patch_of[static_cast<std::size_t>(row)])].middles.push_back(middle);
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

SixColumns RegionRecovery::at_nodes(const ElementMesh& mesh, const SixColumns& at_points) const {
  return mesh.type.degree() == 1 ? at_nodes_with<kLinear>(mesh, at_points) : at_nodes_with<kQuadratic>(mesh, at_points);
}

template <int kCoefficients>
SixColumns RegionRecovery::at_nodes_with(const ElementMesh& mesh, const SixColumns& at_points) const {
  using Coefficients = Eigen::Matrix<double, kCoefficients, 1>;
  using Row = Eigen::Matrix<double, 1, 6>;
  SixColumns out = SixColumns::Zero(static_cast<Eigen::Index>(nodes_.size()), 6);
  for (const auto& [row, elements, fit, middles] : patches_) {
    const Coefficients means = fit.means;
    const auto relative = [&](const Vec3& place) -> Coefficients {
      return monomials<kCoefficients>(fit.to_patch * (place - fit.centre)) - means;
    };
    Row sum = Row::Zero();
    Eigen::Matrix<double, kCoefficients, 6> moments = Eigen::Matrix<double, kCoefficients, 6>::Zero();
    for (const int element : elements)
      for (Eigen::Index point = per_element_ * element; point < per_element_ * (element + 1); ++point) {
        const Row value = at_points.row(point);
        sum += value;
        moments += relative(places_.col(point)) * value;
      }
    const Row mean = sum / static_cast<double>(per_element_ * static_cast<Eigen::Index>(elements.size()));
    const Eigen::Matrix<double, kCoefficients, 6> slopes = fit.inverse * moments;
    const auto value_at = [&](int node) -> Row {
      return mean + relative(mesh.nodes[static_cast<std::size_t>(nodes_[static_cast<std::size_t>(node)])]).transpose() *
                        slopes;
    };
    out.row(row) = value_at(row);
    for (const int middle : middles) out.row(middle) += 0.5 * value_at(middle);
  }
  return out;
}

const std::vector<StressRecovery::Region>& StressRecovery::regions() const {
  std::call_once(once_, [&] {
    const ElementMesh mesh(mesh_);
    for (const auto& term : terms_) regions_.push_back(make_region(mesh, *term));
  });
  return regions_;
}

StressRecovery::Region StressRecovery::make_region(const ElementMesh& mesh, const ElasticTerm& term) const {
  std::vector<int> own, places;
  for (int k = 0; k < term.size(); ++k) own.push_back(term.cell(k)), places.push_back(k);
  if (!subdomain_) return {RegionRecovery(mesh, own, term.num_points()), places};
  const auto name = std::find(mesh_.region_names.begin(), mesh_.region_names.end(), term.region());
  const auto region = static_cast<int>(name - mesh_.region_names.begin());
  std::vector<int> all;
  for (int cell = 0; cell < static_cast<int>(mesh_.region_of.size()); ++cell)
    if (mesh_.region_of[static_cast<std::size_t>(cell)] == region) all.push_back(cell);
  for (std::size_t k = 0; k < own.size(); ++k)
    places[k] = static_cast<int>(std::lower_bound(all.begin(), all.end(), own[k]) - all.begin());
  return {RegionRecovery(mesh, all, term.num_points()), places};
}

SixColumns StressRecovery::of_all_ranks(std::size_t region, SixColumns at_points) const {
  if (!subdomain_) return at_points;
  const auto& [recovery, places] = regions()[region];
  const Eigen::Index points = terms_[region]->num_points();
  SixColumns all = SixColumns::Zero(points * static_cast<Eigen::Index>(recovery.cells().size()), 6);
  for (std::size_t k = 0; k < places.size(); ++k)
    all.middleRows(points * places[k], points) = at_points.middleRows(points * static_cast<Eigen::Index>(k), points);
  subdomain_->ranks().sum({all.data(), static_cast<std::size_t>(all.size())});
  return all;
}

StressRecovery::OfRegion StressRecovery::at_nodes_of_region(std::size_t region, const NodalState& s,
                                                             const Seen& seen) const {
  const ElasticTerm& term = *terms_[region];
  const RegionRecovery& recovery = regions()[region].recovery;
  const auto value = [&](int k, int p) { return seen(term.observe_point(k, p, s)); };
  return {&recovery.nodes(), recovery.at_nodes(ElementMesh(mesh_), of_all_ranks(region, at_points(term, value)))};
}

Eigen::Matrix<double, 6, Eigen::Dynamic> StressRecovery::at_nodes(const NodalState& s, const Seen& seen) const {
  const auto nodes_of_mesh = static_cast<Eigen::Index>(num_nodes());
  Eigen::Matrix<double, 6, Eigen::Dynamic> sum = Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, nodes_of_mesh);
  std::vector<int> count(num_nodes(), 0);
  for (std::size_t r = 0; r < terms_.size(); ++r) {
    const auto [nodes, values] = at_nodes_of_region(r, s, seen);
    for (std::size_t i = 0; i < nodes->size(); ++i) {
      const int node = (*nodes)[i];
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
  for (std::size_t r = 0; r < terms_.size(); ++r) {
    const SixColumns stress = of_all_ranks(r, stresses(*terms_[r], s));
    all.push_back(mesh_error(mesh, *terms_[r], regions()[r].recovery, regions()[r].places, stress));
  }
  return all;
}

StressMisfit StressRecovery::misfit_of(const std::vector<SixColumns>& at_points) const {
  const ElementMesh mesh(mesh_);
  StressMisfit all;
  for (std::size_t r = 0; r < terms_.size(); ++r)
    all.push_back(misfit_of_region(mesh, regions()[r].recovery, at_points[r]));
  return all;
}

StressMisfit StressRecovery::misfit(const NodalState& s) const {
  std::vector<SixColumns> computed;
  for (std::size_t r = 0; r < terms_.size(); ++r) computed.push_back(of_all_ranks(r, stresses(*terms_[r], s)));
  return misfit_of(computed);
}

// By the difference over a displacement that is small beside the body.
StressMisfit StressRecovery::misfit_along(const NodalVector& direction, const NodalState& s) const {
  const double extent = bounding_box(mesh_).size().minCoeff();
  const double in_part = direction.size() > 0 ? direction.lpNorm<Eigen::Infinity>() : 0;
  const double largest = subdomain_ ? subdomain_->ranks().max(in_part) : in_part;
  const double step = kSmallStep * extent / (largest > 0 ? largest : 1);
  const NodalVector more_x = s.x + step * direction, less_x = s.x - step * direction;
  const NodalVector more_u = s.u + step * direction, less_u = s.u - step * direction;
  std::vector<SixColumns> derivatives;
  for (std::size_t r = 0; r < terms_.size(); ++r)
    derivatives.push_back(of_all_ranks(r, (stresses(*terms_[r], {s.t, more_x, more_u, s.v}) -
                                           stresses(*terms_[r], {s.t, less_x, less_u, s.v})) / (2 * step)));
  return misfit_of(derivatives);
}

double StressRecovery::product(const StressMisfit& a, const StressMisfit& b) const {
  const ElementMesh mesh(mesh_);
  double sum = 0;
  for (std::size_t r = 0; r < terms_.size(); ++r) {
    if (terms_[r]->size() == 0) continue;
    const EnergyOfStress energy(mesh, *terms_[r]);
    const Eigen::Index nodes = mesh.cells.nodes_per_cell();
    for (int k = 0; k < terms_[r]->size(); ++k) {
      const Eigen::Index first = nodes * regions()[r].places[static_cast<std::size_t>(k)];
      sum += 2 * energy.volume(k) * energy.density(k, a[r].middleRows(first, nodes), b[r].middleRows(first, nodes));
    }
  }
  return subdomain_ ? subdomain_->ranks().sum(sum) : sum;
}

}  // namespace orthodyn
