// Implements ElementType for an element E of lib/element, with elasticity compiled for every law and stiffness. This
// header is expensive to compile: include it only in the file that defines the element type.
#pragma once

#include "lib/element/linear_law.h"
#include "lib/element/warped_law.h"
#include "lib/fem/element_type.h"
#include "lib/fem/terms/added_term_of.h"
#include "lib/fem/terms/mixed_elastic_term.h"
#include "lib/material/stiffness_contrast.h"

namespace orthodyn {

template <Element E>
class ElementTypeOf final : public ElementType {
  static_assert(E::kNodes <= kMostNodes, "raise ElementType::kMostNodes");

 public:
  ElementTypeOf() = default;  // with the integration points of E
  explicit ElementTypeOf(IntegrationRule rule) : rule_(std::move(rule)) {}

  CellShape shape() const override { return E::kShape; }
  int num_points() const override { return rule_ ? static_cast<int>(rule_->points.size()) : E::kPoints; }

  Nodes part(const Nodes& X) const override {
    if constexpr (HasIntegrationRules<E>)
      if (rule_) {
        Nodes out(3, E::kNodes);
        for (int a = 0; a < E::kNodes; ++a) out.col(a) = X * E::shape(rule_->nodes.col(a));
        return out;
      }
    return X;
  }

  bool holds(int node) const override {
    if constexpr (HasIntegrationRules<E>) {
      if (!rule_) return true;
      const auto heights = rule_->nodes.row(2);
      const double height = E::nodes()(2, node);
      return height >= heights.minCoeff() && height <= heights.maxCoeff();
    } else return true;
  }

  std::unique_ptr<const ElementType> ply(double begin, double end) const override {
    if constexpr (HasIntegrationRules<E>)
      return std::make_unique<ElementTypeOf>(E::part_of_rule(rule_ ? *rule_ : E::own_rule(), begin, end));
    else return nullptr;
  }

  Eigen::Matrix3Xd points(const Nodes& X) const override {
    Eigen::Matrix3Xd out(3, num_points());
    for (int p = 0; p < num_points(); ++p) out.col(p) = place_of(p, X);
    return out;
  }

  int degree() const override { return E::kDegree; }
  Eigen::MatrixXd points_to_nodes() const override {
    return rule_ ? rule_->to_nodes : Eigen::MatrixXd(E::points_to_nodes());
  }

  Vector lumped_mass(const Nodes& X, double density) const override {
    return E::mass(X, density) * Eigen::Map<const Eigen::Matrix<double, E::kNodes, 1>>(E::kLumpedShares.data());
  }
  Eigen::MatrixXd consistent_mass(const Nodes& X, double density) const override {
    return E::consistent_mass(X, density);
  }
  double lumped_to_consistent() const override { return E::kLumpedToConsistent; }

  bool has_mixed_formulation() const override { return E::kPressures > 0; }

  std::unique_ptr<ElasticTerm> elastic_term(const ElementMesh& mesh, ElasticRegion region,
                                            const BlockPattern& pattern) const override {
    const Stiffness stiffness = region.stiffness;
    return std::visit([&](const auto& C) { return term_with_stiffness(C, mesh, std::move(region), pattern); },
                      stiffness);
  }

  std::unique_ptr<AddedTerm> added_term(const ElementMesh& mesh, const ElasticTerm& elastic,
                                        std::unique_ptr<const AddedLaw> law,
                                        const BlockPattern& pattern) const override {
    return std::make_unique<AddedTermOf<E>>(mesh, elastic, std::move(law), pattern, rule_ ? &*rule_ : nullptr);
  }

 private:
  Vec3 place_of(int p, const ElementNodes<E::kNodes>& X) const {
    if constexpr (HasIntegrationRules<E>)
      if (rule_) return X * E::shape(rule_->points[static_cast<std::size_t>(p)].place);
    return E::place_of(p, X);
  }

  template <class C>
  std::unique_ptr<ElasticTerm> term_with_stiffness(const C& stiffness, const ElementMesh& mesh, ElasticRegion region,
                                                   const BlockPattern& pattern) const {
    const ElasticityOptions options = region.options;
    if constexpr (E::kPressures > 0)
      if (region.mixed) return mixed_term(stiffness, mesh, std::move(region), pattern);
    const auto with = [&](const auto& law) -> std::unique_ptr<ElasticTerm> {
      return std::make_unique<ElasticTermOf<E, std::decay_t<decltype(law)>>>(*this, mesh, std::move(region), law,
                                                                             pattern, rule_ ? &*rule_ : nullptr);
    };
    if (options.kinematics == Kinematics::linear) return with(LinearLaw<C>(stiffness));
    if (options.corotation == Corotation::warped) return with(WarpedLaw<C>(stiffness, options.warped_tangent));
    return with(CorotationalLaw<C>(stiffness));
  }

  template <class C>
  std::unique_ptr<ElasticTerm> mixed_term(const C& stiffness, const ElementMesh& mesh, ElasticRegion region,
                                          const BlockPattern& pattern) const {
    constexpr bool kProjectsAll = E::kDegree == 1 || E::kPressures > 1;
    const Stiffness& softest = region.softest();
    const double all = volumetric_modulus(softest), projected = kProjectsAll ? all : excess_bulk_modulus(softest);
    const BulkModuli kappa{projected, all - projected};
    const C rest = without_bulk(stiffness, all);
    const auto with = [&](const auto& law) -> std::unique_ptr<ElasticTerm> {
      return std::make_unique<MixedElasticTermOf<E, std::decay_t<decltype(law)>>>(
          *this, mesh, std::move(region), law, kappa, pattern, rule_ ? &*rule_ : nullptr);
    };
    if (region.options.kinematics == Kinematics::linear) return with(LinearLaw<C>(rest));
    return with(CorotationalLaw<C>(rest));
  }

  std::optional<IntegrationRule> rule_;  // empty: the points of E
};

}  // namespace orthodyn
