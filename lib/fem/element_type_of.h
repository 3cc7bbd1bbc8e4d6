// Implements ElementType for an element E of lib/element, with elasticity compiled for every law and stiffness. This
// header is expensive to compile: include it only in the file that defines the element type.
#pragma once

#include "lib/element/linear_law.h"
#include "lib/element/warped_law.h"
#include "lib/fem/element_type.h"
#include "lib/fem/terms/elastic_term_of.h"

namespace orthodyn {

template <Element E>
class ElementTypeOf final : public ElementType {
  static_assert(E::kNodes <= kMostNodes && E::kPoints <= kMostNodes, "raise ElementType::kMostNodes");

 public:
  CellShape shape() const override { return E::kShape; }
  int num_points() const override { return E::kPoints; }

  Nodes points(const Nodes& X) const override {
    Nodes out(3, E::kPoints);
    for (int p = 0; p < E::kPoints; ++p) out.col(p) = E::place_of(p, X);
    return out;
  }

  int degree() const override { return E::kDegree; }
  Eigen::MatrixXd points_to_nodes() const override { return E::points_to_nodes(); }

  Vector lumped_mass(const Nodes& X, double density) const override {
    return E::mass(X, density) * Eigen::Map<const Eigen::Matrix<double, E::kNodes, 1>>(E::kLumpedShares.data());
  }
  Eigen::MatrixXd consistent_mass(const Nodes& X, double density) const override {
    return E::consistent_mass(X, density);
  }
  double lumped_to_consistent() const override { return E::kLumpedToConsistent; }

  std::unique_ptr<ElasticTerm> elastic_term(const ElementMesh& mesh, ElasticRegion region,
                                            const BlockPattern& pattern) const override {
    const Stiffness stiffness = region.stiffness;
    return std::visit([&](const auto& C) { return term_with_stiffness(C, mesh, std::move(region), pattern); },
                      stiffness);
  }

 private:
  template <class C>
  static std::unique_ptr<ElasticTerm> term_with_stiffness(const C& stiffness, const ElementMesh& mesh,
                                                          ElasticRegion region, const BlockPattern& pattern) {
    const ElasticityOptions options = region.options;
    const auto with = [&](const auto& law) -> std::unique_ptr<ElasticTerm> {
      return std::make_unique<ElasticTermOf<E, std::decay_t<decltype(law)>>>(mesh, std::move(region), law, pattern);
    };
    if (options.kinematics == Kinematics::linear) return with(LinearLaw<C>(stiffness));
    if (options.corotation == Corotation::warped) return with(WarpedLaw<C>(stiffness, options.warped_tangent));
    return with(CorotationalLaw<C>(stiffness));
  }
};

}  // namespace orthodyn
