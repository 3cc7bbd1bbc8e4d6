#include "lib/fem/misfit_energy.h"

#include <optional>

#include "lib/material/stiffness.h"

namespace orthodyn {

namespace {

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

}  // namespace

SixColumns misfit_of_region(const ElementMesh& mesh, const RegionRecovery& recovery, const SixColumns& computed) {
  const NodalStresses at(mesh, recovery, computed);
  SixColumns out(at.nodes() * static_cast<Eigen::Index>(recovery.cells().size()), 6);
  for (Eigen::Index k = 0; k < out.rows() / at.nodes(); ++k)
    out.middleRows(at.nodes() * k, at.nodes()) = at.misfit(k, at.computed(k));
  return out;
}

RegionMeshError mesh_error(const ElementMesh& mesh, const ElasticTerm& term, const RegionRecovery& recovery,
                           const std::vector<int>& places, const SixColumns& computed) {
  RegionMeshError out{Vector(term.size()), Vector(term.size()), 0};
  if (term.size() == 0) return out;
  const NodalStresses at(mesh, recovery, computed);
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
  const Eigen::Index nodes = mesh.cells.nodes_per_cell();
  double sum = 0;
  for (int k = 0; k < term.size(); ++k) {
    const Eigen::Index first = nodes * places[static_cast<std::size_t>(k)];
    sum += 2 * energy.volume(k) * energy.density(k, a.middleRows(first, nodes), b.middleRows(first, nodes));
  }
  return sum;
}

}  // namespace orthodyn
