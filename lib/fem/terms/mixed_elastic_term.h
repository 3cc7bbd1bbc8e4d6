// Elasticity in the mixed formulation, for nearly incompressible materials. The volume strain theta = J - 1 (for small
// strain tr H) is projected onto polynomials in each element (volume_projection.h):
//
//     E = integral of Psi' + kappa_1/2 (pi theta)^2 + kappa_2/2 theta^2,    kappa_1 + kappa_2 = volumetric_modulus(C),
//
// where Psi' is the law's energy for C' = C - (kappa_1 + kappa_2) I (x) I. For isotropic materials this is
// mu |S - I|^2 + lambda/2 (J - 1)^2 (fixed corotated: Stomakhin, Howes, Schroeder & Teran 2012, SCA). C' keeps a bulk
// modulus, without which a body that is collapsed to a point would stay there, since J has no gradient at F = 0.
//
// Elements with several pressures and linear ones project all, kappa_2 = 0. Quadratic elements with a constant pressure
// have kappa_1 = excess_bulk_modulus(C). Otherwise a cell that bends would have no stiffness against the part of theta
// that varies within it: a beam of one tetrahedron through its thickness would be 50 % too soft, one of wedges five
// times too soft.
//
// With the law's own tr(S - I) for theta, which differs from J - 1 by second-order terms, a block of rubber that is
// compressed by a tenth between bonded plates would lose two fifths of its volume at places.
//
// This is the displacement-pressure formulation with the pressure -kappa_1 pi theta eliminated in each element (Malkus
// & Hughes 1978, Comput. Methods Appl. Mech. Eng. 15, 63): the mean dilatation for a constant pressure (Nagtegaal,
// Parks & Rice 1974), Q2-P1 for a linear one. The force is -dE/du, so the tangent is symmetric.
//
// The base class computes the part of C'. This class adds the volumetric stress s = kappa_1 pi theta + kappa_2 theta
// (Pa, positive in tension): with G_p = V_p grad theta_p and g_i = sum_p psi_i G_p, the force is -sum_p s_p G_p and the
// tangent kappa_1 sum g_i g_i^T + kappa_2 sum G_p G_p^T / V_p plus V s times the second derivative of theta. V_p and
// psi_i: volume_projection.h.
#pragma once

#include <stdexcept>

#include "lib/element/volume_strain.h"
#include "lib/fem/terms/elastic_term_of.h"
#include "lib/fem/terms/volume_projection.h"

namespace orthodyn {

// kappa_1 and kappa_2, Pa.
struct BulkModuli {
  double projected, local;
};

template <Element E, class Law>
class MixedElasticTermOf final : public ElasticTermOf<E, Law> {
 public:
  // `law`: of C'. Other arguments as in the base class.
  MixedElasticTermOf(const ElementType& type, const ElementMesh& mesh, ElasticRegion region, const Law& law,
                     const BulkModuli& kappa, const BlockPattern& pattern, const IntegrationRule* rule)
      : Base(type, mesh, std::move(region), law, pattern, rule),
        kappa_(kappa),
        projection_(type, mesh, this->definition().cells, elements_) {
    if (num_points() > static_cast<int>(kMostPoints)) throw std::logic_error("raise kMostPoints");
  }

  std::string description() const override { return Base::description() + ", mixed formulation"; }
  std::size_t bytes() const override { return Base::bytes() + projection_.bytes(); }

  void add_force(const NodalState& s, NodalVector& f) const override {
    Base::add_force(s, f);
    loops_.for_each_batch([&](int b) {
      const Volume volume = volume_at(b, s.u);
      PointValues stress = stress_of(b, theta_of(volume));
      if (damped()) {
        const PointValues viscous = stress_of(b, rate_of(b, s, volume));
        for (int p = 0; p < num_points(); ++p) at(stress, p) += Batch(beta()) * at(viscous, p);
      }
      Columns force;
      for (int p = 0; p < num_points(); ++p)
        elements_.add_forces(b, p, at(stress, p) * at(volume, p).gradient, p == 0, force);
      elements_.scatter(b, force, f);
    });
  }

  void add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const override {
    Base::add_mean_force(s0, s1, f);
    loops_.for_each_batch([&](int b) {
      PointValues theta = theta_of(volume_at(b, s0.u));
      const PointValues theta_1 = theta_of(volume_at(b, s1.u));
      for (int p = 0; p < num_points(); ++p) at(theta, p) = Batch(0.5) * (at(theta, p) + at(theta_1, p));
      const PointValues stress = stress_of(b, theta);
      for (int p = 0; p < num_points(); ++p)
        loops_.for_each_of(b, [&](int k) {
          const Mat3 H0 = elements_.gradient(k, p, s0.u), H1 = elements_.gradient(k, p, s1.u);
          const Mat3 D = law_.mean_volume_gradient(H0, H1, axes().of(k, p));
          elements_.add_force(k, p, at(stress, p)[k % Batch::kLanes] * D, f);
        });
    });
  }

  void add_tangent(const NodalState& s, TangentKind kind, double* K, double* D) const override {
    this->add_tangents(s, kind, K, D, [&](int b) {
      const Volume volume = volume_at(b, s.u);
      return TangentPart(*this, b, volume, stress_of(b, theta_of(volume)), kind);
    });
  }

  void add_predicted_tangent(const NodalState& before, const NodalState& s, double* K) const override {
    this->add_predicted_tangents(before, s, K, [&](int b) {
      return TangentPart(*this, b, volume_at(b, s.u), predicted_stress(b, before.u, s.u), TangentKind::exact);
    });
  }

  double energy(const NodalState& s) const override {
    return Base::energy(s) + 0.5 * loops_.sum([&](int b) { return twice_energy(b, theta_of(volume_at(b, s.u))); });
  }

  double dissipation(const NodalState& s) const override {
    if (!damped()) return 0;
    return Base::dissipation(s) +
           beta() * loops_.sum([&](int b) { return twice_energy(b, rate_of(b, s, volume_at(b, s.u))); });
  }

  Eigen::Matrix<double, 6, Eigen::Dynamic> stresses(const NodalState& s) const override {
    const Mat6 C = voigt(without_bulk_of_definition());
    Eigen::Matrix<double, 6, Eigen::Dynamic> out = C * Base::strains(s);
    for_each_stress(
        s, [&](int k, int p, double stress) { out.col(k * num_points() + p).template head<3>().array() += stress; });
    return out;
  }

  PointObservation observe_point(int k, int p, const NodalState& s) const override {
    return observe_element(k, s)[static_cast<std::size_t>(p)];
  }

  std::vector<PointObservation> observe_element(int k, const NodalState& s) const override {
    std::vector<PointObservation> all = Base::observe_element(k, s);
    const int b = k / Batch::kLanes;
    const PointValues stress = stress_of(b, theta_of(volume_at(b, s.u)));
    for (int p = 0; p < num_points(); ++p)
      add_pressure(at(stress, p)[k % Batch::kLanes], all[static_cast<std::size_t>(p)]);
    return all;
  }

  void observe_points(const NodalState& s, const ElasticTerm::VisitPoint& visit) const override {
    std::vector<double> stress(static_cast<std::size_t>(this->size() * num_points()));
    for_each_stress(
        s, [&](int k, int p, double value) { stress[static_cast<std::size_t>(k * num_points() + p)] = value; });
    Base::observe_points(s, [&](int k, int p, PointObservation observation) {
      add_pressure(stress[static_cast<std::size_t>(k * num_points() + p)], observation);
      visit(k, p, observation);
    });
  }

  PointObservation observe(int k, const NodalState& s) const override {
    PointObservation out = Base::observe(k, s);
    const int b = k / Batch::kLanes;
    const PointValues stress = stress_of(b, theta_of(volume_at(b, s.u)));
    double sum = 0, volume = 0;
    for (int p = 0; p < num_points(); ++p) {
      sum += elements_.volume(k, p) * at(stress, p)[k % Batch::kLanes];
      volume += elements_.volume(k, p);
    }
    add_pressure(sum / volume, out);
    return out;
  }

 private:
  using Base = ElasticTermOf<E, Law>;
  using Columns = typename ElementBatches<E>::Columns;
  using Coefficients = typename VolumeProjection<E>::Coefficients;
  using Base::assembly_, Base::elements_, Base::law_, Base::loops_, Base::axes, Base::damped, Base::num_points;
  static constexpr int kTerms = VolumeProjection<E>::kTerms;
  static constexpr std::size_t kMostPoints = HasIntegrationRules<E> ? 27 : E::kPoints;

  // One value, or one volume strain, per point of a batch.
  using PointValues = std::array<Batch, kMostPoints>;
  using Volume = std::array<VolumeStrain<Batch>, kMostPoints>;
  template <class Array>
  static auto& at(Array& values, int p) {
    return values[static_cast<std::size_t>(p)];
  }

  double beta() const { return this->definition().beta; }
  Stiffness without_bulk_of_definition() const {
    return std::visit([&](const auto& C) -> Stiffness { return without_bulk(C, kappa_.projected + kappa_.local); },
                      this->definition().stiffness);
  }

  Volume volume_at(int b, const NodalVector& u) const {
    Volume out;
    const Columns differences = elements_.differences(b, u);
    for (int p = 0; p < num_points(); ++p)
      at(out, p) = law_.volume_strain(elements_.gradients(b, p, differences), axes().batch(b, p));
    return out;
  }

  PointValues theta_of(const Volume& volume) const {
    PointValues theta;
    for (int p = 0; p < num_points(); ++p) at(theta, p) = at(volume, p).value;
    return theta;
  }

  // The change of theta by a small displacement d, or its rate for a velocity d.
  PointValues change_along(int b, const Columns& d, const Volume& volume) const {
    PointValues change;
    for (int p = 0; p < num_points(); ++p)
      at(change, p) = contract<Batch>(at(volume, p).gradient, elements_.gradients(b, p, d));
    return change;
  }
  PointValues rate_of(int b, const NodalState& s, const Volume& volume) const {
    return change_along(b, elements_.differences(b, s.v), volume);
  }

  Coefficients projection_of(int b, const PointValues& theta) const {
    Coefficients t;
    t.fill(Batch(0));
    for (int p = 0; p < num_points(); ++p) projection_.add(b, p, elements_.volumes(b, p) * at(theta, p), t);
    return t;
  }

  // kappa_1 pi theta + kappa_2 theta. For rates of theta: the viscous stress divided by beta.
  PointValues stress_of(int b, const PointValues& theta) const {
    const Coefficients t = projection_of(b, theta);
    PointValues stress;
    for (int p = 0; p < num_points(); ++p)
      at(stress, p) = Batch(kappa_.projected) * projection_.at(b, p, t) + Batch(kappa_.local) * at(theta, p);
    return stress;
  }

  // The volumetric stress of the displacement u, linear in u - u0 (predicted_tangent() of corotational_law.h).
  PointValues predicted_stress(int b, const NodalVector& u0, const NodalVector& u) const {
    const Volume volume = volume_at(b, u0);
    const Columns d = elements_.differences(b, u) - elements_.differences(b, u0);
    PointValues theta = change_along(b, d, volume);
    for (int p = 0; p < num_points(); ++p) at(theta, p) += at(volume, p).value;
    return stress_of(b, theta);
  }

  // Integral of kappa_1 (pi theta)^2 + kappa_2 theta^2 over a batch.
  double twice_energy(int b, const PointValues& theta) const {
    Batch sum(0);
    for (const Batch& t : projection_of(b, theta)) sum += Batch(kappa_.projected) * t * t;
    for (int p = 0; p < num_points(); ++p)
      sum += Batch(kappa_.local) * elements_.volumes(b, p) * at(theta, p) * at(theta, p);
    double total = 0;
    for (int l = 0; l < Batch::kLanes; ++l) total += sum[l];
    return total;
  }

  // Calls visit(k, p, s) for all elements and points with the elastic volumetric stress s.
  template <class Visit>
  void for_each_stress(const NodalState& s, Visit&& visit) const {
    loops_.for_each_batch([&](int b) {
      const PointValues stress = stress_of(b, theta_of(volume_at(b, s.u)));
      for (int p = 0; p < num_points(); ++p)
        loops_.for_each_of(b, [&](int k) { visit(k, p, at(stress, p)[k % Batch::kLanes]); });
    });
  }

  // The Cauchy stress of s is s cof(F) F^T / J = s I.
  static void add_pressure(double stress, PointObservation& out) { out.cauchy.diagonal().array() += stress; }

  // The part of a batch's tangent that the volumetric stress adds.
  class TangentPart {
   public:
    static constexpr bool kIsEmpty = false;

    TangentPart(const MixedElasticTermOf& term, int b, const Volume& volume, const PointValues& stress,
                TangentKind kind)
        : term_(term), b_(b), volume_(volume), stress_(stress), has_curvature_(kind == TangentKind::exact) {
      for (std::size_t i = 0; i < kTerms; ++i)
        for (int p = 0; p < term.num_points(); ++p)
          term.elements_.add_forces(
              b, p, Mat3T<Batch>(-term.projection_.polynomial(b, p, static_cast<int>(i)) * at(volume, p).gradient),
              p == 0, projected_[i]);
    }

    // Adds V s d2 theta of a point to the blocks of nodes 1, 2, ..., of the whole batch or of one lane.
    template <class Point, class Blocks>
    void add_curvature(int p, const Point& point, bool symmetric, Blocks& blocks) const {
      if (!Law::kHasVolumeCurvature || !has_curvature_) return;
      add_volume_curvature<E::kNodes, Batch>(at(volume_, p).F, point.volume * at(stress_, p), point, symmetric, blocks);
    }
    template <class Point, class Blocks>
    void add_curvature_of_lane(int p, int lane, const Point& point, bool symmetric, Blocks& blocks) const {
      if (!Law::kHasVolumeCurvature || !has_curvature_) return;
      add_volume_curvature<E::kNodes, double>(lane_of_matrix(at(volume_, p).F, lane),
                                              point.volume * at(stress_, p)[lane], point, symmetric, blocks);
    }

    // Adds kappa_1 sum g_i g_i^T + kappa_2 sum G_p G_p^T / V_p times `factor` to the blocks of nodes 1, 2, ...
    void add_to(double factor, bool symmetric, ElementBlocks<E::kNodes, Batch>& blocks) const {
      for_each_product(
          factor, [&](const Columns& scaled, const Columns& g) { add_products<Batch>(scaled, g, symmetric, blocks); });
    }
    void add_to_lane(double factor, bool symmetric, int lane, ElementBlocks<E::kNodes>& blocks) const {
      for_each_product(factor, [&](const Columns& scaled, const Columns& g) {
        add_products<double>(lane_of_matrix(scaled, lane), lane_of_matrix(g, lane), symmetric, blocks);
      });
    }

   private:
    // Calls visit(kappa g, g) for the terms of the sums.
    template <class Visit>
    void for_each_product(double factor, Visit&& visit) const {
      for (const Columns& g : projected_) visit(Columns(Batch(factor * term_.kappa_.projected) * g), g);
      if (term_.kappa_.local == 0) return;
      for (int p = 0; p < term_.num_points(); ++p) {
        Columns local;  // -grad theta of the nodes, times V
        term_.elements_.add_forces(b_, p, at(volume_, p).gradient, true, local);
        const Batch V = term_.elements_.volumes(b_, p), safe = select(V > Batch(0), V, Batch(1));  // padding has V = 0
        visit(Columns(Batch(factor * term_.kappa_.local) / safe * local), local);
      }
    }

    template <class M>
    static auto lane_of_matrix(const M& all, int lane) {
      return Eigen::Matrix<double, M::RowsAtCompileTime, M::ColsAtCompileTime>(
          all.unaryExpr([lane](const Batch& x) { return x[lane]; }));
    }
    template <class T, class G>
    static void add_products(const G& left, const G& right, bool symmetric, ElementBlocks<E::kNodes, T>& blocks) {
      for (int b = 0; b < E::kNodes - 1; ++b)
        for (int a = symmetric ? b : 0; a < E::kNodes - 1; ++a)
          blocks[static_cast<std::size_t>(a) + 1][static_cast<std::size_t>(b) + 1] +=
              left.col(a) * right.col(b).transpose();
    }

    const MixedElasticTermOf& term_;
    int b_;
    Volume volume_;
    PointValues stress_;
    std::array<Columns, static_cast<std::size_t>(kTerms)> projected_;  // g_i at nodes 1, 2, ...
    bool has_curvature_;
  };

  BulkModuli kappa_;
  VolumeProjection<E> projection_;
};

}  // namespace orthodyn
