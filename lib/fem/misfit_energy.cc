#include <optional>

#include "lib/fem/stress_recovery.h"
#include "lib/material/stiffness.h"

namespace orthodyn {

namespace {

// Values of one element, one row per node or point.
constexpr int kMostNodes = ElementType::kMostNodes;
using ElementRows = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor, kMostNodes, 6>;
using NodeMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostNodes, kMostNodes>;

// Elastic energy of stress fields given at the nodes of a term's elements.
class EnergyOfStress {
 public:
  EnergyOfStress(const ElementMesh& mesh, const ElasticTerm& term)
      : mesh_(mesh),
        term_(term),
        type_(term.type()),
        compliance_(Mat6(term.stiffness().inverse())),
        straight_(topology(type_.shape()).corners == kCornersOfTet ? shares_of(unit_tetrahedron()) : NodeMatrix()) {
    if (term.definition().axes.uniform()) in_space_ = compliance_in_space(0);
  }

  double volume(int k) const { return type_.lumped_mass(positions(k), 1).sum(); }

  // Mean of a : C^-1 : b / 2 over the element, J/m^3.
  double density(int k, const ElementRows& a, const ElementRows& b) const {
    const Mat6 compliance = in_space_ ? *in_space_ : compliance_in_space(k);
    const ElementRows of_b = shares(k).lazyProduct(b);
    return 0.5 * a.lazyProduct(compliance).cwiseProduct(of_b).sum();
  }

 private:
  static constexpr int kCornersOfTet = 4;

  // Integrals of N_a N_b divided by the volume: the same for all tetrahedra with straight edges.
  NodeMatrix shares(int k) const {
    const ElementType::Nodes X = positions(k);
    return straight_.size() > 0 && is_straight(X) ? straight_ : shares_of(X);
  }
  NodeMatrix shares_of(const ElementType::Nodes& X) const {
    return type_.consistent_mass(X, 1) / type_.lumped_mass(X, 1).sum();
  }

  // Whether all edges are straight to round-off.
  bool is_straight(const ElementType::Nodes& X) const {
    constexpr double kRoundOff = 1e-14;  // relative to the coordinates
    Eigen::Index middle = kCornersOfTet;
    for (const std::vector<int>& edge : topology(type_.shape()).middles) {
      const auto begin = X.col(edge[0]), end = X.col(edge[1]);
      const Vec3 bulge = X.col(middle++) - (begin + end) / 2;
      if (bulge.norm() > kRoundOff * (begin.norm() + end.norm())) return false;
    }
    return true;
  }

  ElementType::Nodes unit_tetrahedron() const {
    ElementType::Nodes X = ElementType::Nodes::Zero(3, type_.num_nodes());
    X.block<3, 3>(0, 1).setIdentity();
    Eigen::Index middle = kCornersOfTet;
    for (const std::vector<int>& edge : topology(type_.shape()).middles)
      X.col(middle++) = (X.col(edge[0]) + X.col(edge[1])) / 2;
    return X;
  }

  // The compliance in space axes is T^T C^-1 T, where T rotates stresses from space to material axes.
  Mat6 compliance_in_space(int k) const {
    const Mat6 to_material = stress_rotation(term_.axes_at_rest(k, 0).transpose());
    return to_material.transpose() * compliance_ * to_material;
  }

  ElementType::Nodes positions(int k) const {
    return type_.part(mesh_.positions(static_cast<std::size_t>(term_.cell(k))));
  }

  const ElementMesh& mesh_;
  const ElasticTerm& term_;
  const ElementType& type_;
  Mat6 compliance_;
  std::optional<Mat6> in_space_;  // compliance_in_space(), if equal for all elements
  NodeMatrix straight_;           // shares() of a tetrahedron with straight edges; empty for other elements
};

// Stresses of a region at the nodes of its elements: computed() extrapolates from the points, misfit() is recovered
// minus extrapolated.
class NodalStresses {
 public:
  NodalStresses(const ElementType& type, const RegionRecovery& recovery, const SixColumns& computed)
      : cells_(recovery.cells()),
        computed_(computed),
        recovered_(recovery.at_nodes(computed)),
        extrapolation_(type.points_to_nodes()) {}

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
  Eigen::MatrixXd extrapolation_;
};

}  // namespace

SixColumns misfit_of_region(const ElementType& type, const RegionRecovery& recovery, const SixColumns& computed) {
  const NodalStresses at(type, recovery, computed);
  SixColumns out(at.nodes() * static_cast<Eigen::Index>(recovery.cells().size()), 6);
  for (Eigen::Index k = 0; k < out.rows() / at.nodes(); ++k)
    out.middleRows(at.nodes() * k, at.nodes()) = at.misfit(k, at.computed(k));
  return out;
}

RegionMeshError mesh_error(const ElementMesh& mesh, const ElasticTerm& term, const RegionRecovery& recovery,
                           const std::vector<int>& places, const SixColumns& computed) {
  RegionMeshError out{Vector(term.size()), Vector(term.size()), 0};
  if (term.size() == 0) return out;
  const NodalStresses at(term.type(), recovery, computed);
  const EnergyOfStress energy(mesh, term);
  for (int k = 0; k < term.size(); ++k) {
    const int place = places[static_cast<std::size_t>(k)];
    const ElementRows stress = at.computed(place), misfit = at.misfit(place, stress);
    out.volume[k] = energy.volume(k);
    out.error[k] = out.volume[k] * energy.density(k, misfit, misfit);
    out.energy += out.volume[k] * energy.density(k, stress, stress);
  }
  return out;
}

double misfit_product(const ElementMesh& mesh, const ElasticTerm& term, const std::vector<int>& places,
                      const SixColumns& a, const SixColumns& b) {
  if (term.size() == 0) return 0;
  const EnergyOfStress energy(mesh, term);
  const Eigen::Index nodes = term.type().num_nodes();
  double sum = 0;
  for (int k = 0; k < term.size(); ++k) {
    const Eigen::Index first = nodes * places[static_cast<std::size_t>(k)];
    sum += 2 * energy.volume(k) * energy.density(k, a.middleRows(first, nodes), b.middleRows(first, nodes));
  }
  return sum;
}

}  // namespace orthodyn
