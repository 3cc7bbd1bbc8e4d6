// Elasticity in the mixed formulation, for nearly incompressible materials: in the energy of a bulk modulus kappa, the
// volume strain theta is replaced by its projection pi theta onto polynomials in each element (volume_projection.h):
//
//     E = integral of Psi' + kappa/2 (pi theta)^2,    Psi' the law's energy for C' = C - kappa I (x) I.
//
// kappa is bulk_modulus(C). Quadratic elements with a constant pressure project excess_bulk_modulus(C) only. Otherwise
// a cell that bends would have no stiffness against the part of theta that varies within it: a beam of one tetrahedron
// through its thickness would be 50 % too soft, one of wedges five times too soft.
//
// This is the displacement-pressure formulation with the pressure -kappa pi theta eliminated in each element (Malkus &
// Hughes 1978, Comput. Methods Appl. Mech. Eng. 15, 63): the mean dilatation for a constant pressure (Nagtegaal, Parks
// & Rice 1974), Q2-P1 for a linear one. The force is -dE/du, so the tangent is symmetric.
//
// The base class computes the part of C'. This class adds the volumetric stress s = kappa pi theta (Pa, positive in
// tension): with g_i = sum_p V_p psi_i grad theta_p, the force is -kappa sum t_i g_i and the tangent kappa sum g_i
// g_i^T plus s times the second derivative of theta. V_p, psi_i and t_i: volume_projection.h.
#pragma once

#include <optional>
#include <stdexcept>

#include "lib/fem/terms/elastic_term_of.h"
#include "lib/fem/terms/volume_projection.h"

namespace orthodyn {

template <Element E, class Law>
class MixedElasticTermOf final : public ElasticTermOf<E, Law> {
 public:
  // `law`: of C'. `kappa`: the projected part of the bulk modulus, Pa. Other arguments as in the base class.
  MixedElasticTermOf(const ElementType& type, const ElementMesh& mesh, ElasticRegion region, const Law& law,
                     double kappa, const BlockPattern& pattern, const IntegrationRule* rule)
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
      const Coefficients stress = stress_of(volume, with_rate(b, s, volume));
      add_volumetric_force(b, volume, stress, f);
    });
  }

  void add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const override {
    Base::add_mean_force(s0, s1, f);
    loops_.for_each_batch([&](int b) {
      const Coefficients t0 = volume_at(b, s0.u).strain, t1 = volume_at(b, s1.u).strain;
      Coefficients mean;
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = Batch(0.5 * kappa_) * (t0[i] + t1[i]);
      for (int p = 0; p < num_points(); ++p) {
        const Batch stress = projection_.at(b, p, mean);
        loops_.for_each_of(b, [&](int k) {
          const Mat3 H0 = elements_.gradient(k, p, s0.u), H1 = elements_.gradient(k, p, s1.u);
          const Mat3 D = law_.mean_volume_gradient(H0, H1, axes().of(k, p));
          elements_.add_force(k, p, stress[k % Batch::kLanes] * D, f);
        });
      }
    });
  }

  void add_tangent(const NodalState& s, TangentKind kind, double* K, double* D) const override {
    this->add_tangents(s, kind, K, D, [&](int b) {
      const Volume volume = volume_at(b, s.u);
      return TangentPart(*this, b, volume, stress_of(volume, {}), kind);
    });
  }

  void add_predicted_tangent(const NodalState& before, const NodalState& s, double* K) const override {
    this->add_predicted_tangents(before, s, K, [&](int b) {
      return TangentPart(*this, b, volume_at(b, s.u), predicted_stress(b, before.u, s.u), TangentKind::exact);
    });
  }

  double energy(const NodalState& s) const override {
    return Base::energy(s) + 0.5 * kappa_ * loops_.sum([&](int b) { return sum_of_squares(volume_at(b, s.u).strain); });
  }

  double dissipation(const NodalState& s) const override {
    if (!damped()) return 0;
    return Base::dissipation(s) +
           kappa_ * beta() * loops_.sum([&](int b) { return sum_of_squares(rate_of(b, s, volume_at(b, s.u))); });
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
    const Coefficients stress = stress_of(volume_at(b, s.u), {});
    for (int p = 0; p < num_points(); ++p)
      add_stress(elements_.gradient(k, p, s.u), axes().of(k, p), projection_.at(b, p, stress)[k % Batch::kLanes],
                 all[static_cast<std::size_t>(p)]);
    return all;
  }

  void observe_points(const NodalState& s, const ElasticTerm::VisitPoint& visit) const override {
    std::vector<double> stress(static_cast<std::size_t>(this->size() * num_points()));
    for_each_stress(
        s, [&](int k, int p, double value) { stress[static_cast<std::size_t>(k * num_points() + p)] = value; });
    Base::observe_points(s, [&](int k, int p, PointObservation observation) {
      add_stress(elements_.gradient(k, p, s.u), axes().of(k, p), stress[static_cast<std::size_t>(k * num_points() + p)],
                 observation);
      visit(k, p, observation);
    });
  }

  PointObservation observe(int k, const NodalState& s) const override {
    PointObservation out = Base::observe(k, s);
    const int b = k / Batch::kLanes;
    const Coefficients stress = stress_of(volume_at(b, s.u), {});
    double sum = 0, volume = 0;
    for (int p = 0; p < num_points(); ++p) {
      sum += elements_.volume(k, p) * projection_.at(b, p, stress)[k % Batch::kLanes];
      volume += elements_.volume(k, p);
    }
    add_stress(this->mean_gradient(k, s.u), axes().mean(k), sum / volume, out);
    return out;
  }

 private:
  using Base = ElasticTermOf<E, Law>;
  using Columns = typename ElementBatches<E>::Columns;
  using Coefficients = typename VolumeProjection<E>::Coefficients;
  using Base::assembly_, Base::elements_, Base::law_, Base::loops_, Base::axes, Base::damped, Base::num_points;
  static constexpr int kTerms = VolumeProjection<E>::kTerms;
  static constexpr std::size_t kMostPoints = HasIntegrationRules<E> ? 27 : E::kPoints;

  // The volume strain at the points of a batch, and the coefficients of its projection.
  struct Volume {
    std::array<VolumeStrain<Batch>, kMostPoints> at;
    Coefficients strain;
  };

  double beta() const { return this->definition().beta; }
  Stiffness without_bulk_of_definition() const {
    return std::visit([&](const auto& C) -> Stiffness { return without_bulk(C, kappa_); },
                      this->definition().stiffness);
  }

  Volume volume_at(int b, const NodalVector& u) const {
    Volume out;
    out.strain.fill(Batch(0));
    const Columns differences = elements_.differences(b, u);
    for (int p = 0; p < num_points(); ++p) {
      VolumeStrain<Batch>& point = out.at[static_cast<std::size_t>(p)];
      Batch::Mask good;
      point = law_.batch_volume_strain(elements_.gradients(b, p, differences), axes().batch(b, p), good);
      for (int l = 0; l < Batch::kLanes; ++l)
        if (!good[l]) set_lane(std::min(b * Batch::kLanes + l, this->size() - 1), p, l, u, point);
      projection_.add(b, p, elements_.volumes(b, p) * point.value, out.strain);
    }
    return out;
  }

  void set_lane(int k, int p, int lane, const NodalVector& u, VolumeStrain<Batch>& point) const {
    const VolumeStrain<double> one = law_.volume_strain(elements_.gradient(k, p, u), axes().of(k, p));
    const auto set = [lane](Batch& all, double value) {
      double lanes[Batch::kLanes];
      all.store(lanes);
      lanes[lane] = value;
      all = Batch::load(lanes);
    };
    set(point.value, one.value);
    for (int i = 0; i < 9; ++i) {
      set(point.gradient(i), one.gradient(i));
      set(point.curvature(i), one.curvature(i));
    }
  }

  // The change of the coefficients t_i by a small displacement d, or their rate for a velocity d.
  Coefficients change_along(int b, const Columns& d, const Volume& volume) const {
    Coefficients change;
    change.fill(Batch(0));
    for (int p = 0; p < num_points(); ++p) {
      const Mat3T<Batch>& gradient = volume.at[static_cast<std::size_t>(p)].gradient;
      projection_.add(b, p, elements_.volumes(b, p) * contract<Batch>(gradient, elements_.gradients(b, p, d)), change);
    }
    return change;
  }

  // d t_i / dt. Precondition: damped().
  Coefficients rate_of(int b, const NodalState& s, const Volume& volume) const {
    return change_along(b, elements_.differences(b, s.v), volume);
  }

  // The volumetric stress of the displacement u, linear in u - u0 (predicted_tangent() of corotational_law.h).
  Coefficients predicted_stress(int b, const NodalVector& u0, const NodalVector& u) const {
    Volume volume = volume_at(b, u0);
    const Columns d = elements_.differences(b, u) - elements_.differences(b, u0);
    const Coefficients change = change_along(b, d, volume);
    for (std::size_t i = 0; i < change.size(); ++i) volume.strain[i] += change[i];
    return stress_of(volume, {});
  }

  std::optional<Coefficients> with_rate(int b, const NodalState& s, const Volume& volume) const {
    if (!damped()) return {};
    return rate_of(b, s, volume);
  }

  // Coefficients of the volumetric stress: elastic, plus viscous if there is a rate.
  Coefficients stress_of(const Volume& volume, const std::optional<Coefficients>& rate) const {
    Coefficients stress;
    for (std::size_t i = 0; i < stress.size(); ++i) {
      stress[i] = Batch(kappa_) * volume.strain[i];
      if (rate) stress[i] += Batch(kappa_ * beta()) * (*rate)[i];
    }
    return stress;
  }

  void add_volumetric_force(int b, const Volume& volume, const Coefficients& stress, NodalVector& f) const {
    Columns force;
    for (int p = 0; p < num_points(); ++p)
      elements_.add_forces(b, p, projection_.at(b, p, stress) * volume.at[static_cast<std::size_t>(p)].gradient, p == 0,
                           force);
    elements_.scatter(b, force, f);
  }

  static double lane_sum(const Batch& x) {
    double sum = 0;
    for (int l = 0; l < Batch::kLanes; ++l) sum += x[l];
    return sum;
  }
  static double sum_of_squares(const Coefficients& t) {
    double sum = 0;
    for (const Batch& t_i : t) sum += lane_sum(t_i * t_i);
    return sum;
  }

  // Calls visit(k, p, s) for all elements and points with the elastic volumetric stress s.
  template <class Visit>
  void for_each_stress(const NodalState& s, Visit&& visit) const {
    loops_.for_each_batch([&](int b) {
      const Coefficients stress = stress_of(volume_at(b, s.u), {});
      for (int p = 0; p < num_points(); ++p) {
        const Batch at = projection_.at(b, p, stress);
        loops_.for_each_of(b, [&](int k) { visit(k, p, at[k % Batch::kLanes]); });
      }
    });
  }

  void add_stress(const Mat3& H, const Mat3& Q, double stress, PointObservation& out) const {
    out.cauchy += law_.cauchy_of_volumetric(stress, H, Q);
  }

  // The part of a batch's tangent that the volumetric stress adds.
  class TangentPart {
   public:
    TangentPart(const MixedElasticTermOf& term, int b, const Volume& volume, const Coefficients& stress,
                TangentKind kind)
        : term_(term), b_(b), volume_(volume), stress_(stress), has_curvature_(kind == TangentKind::exact) {
      for (std::size_t i = 0; i < kTerms; ++i)
        for (int p = 0; p < term.num_points(); ++p)
          term.elements_.add_forces(b, p,
                                    Mat3T<Batch>(-term.projection_.polynomial(b, p, static_cast<int>(i)) *
                                                 volume_.at[static_cast<std::size_t>(p)].gradient),
                                    p == 0, gradient_[i]);
    }

    // Adds s d2 theta to the tangent form at a point, of the whole batch or of one lane.
    template <class Form>
    void add_to(int p, Form& form) const {
      if (has_curvature_) form.Haa += curvature(p);
    }
    template <class Form>
    void add_to_lane(int p, int lane, Form& form) const {
      if (has_curvature_) form.Haa += lane_of_matrix(curvature(p), lane);
    }

    // Adds kappa g_i g_i^T times `factor` to the blocks of nodes 1, 2, ...
    void add_to(double factor, bool symmetric, ElementBlocks<E::kNodes, Batch>& blocks) const {
      for (const Columns& g : gradient_) {
        const Columns scaled = Batch(factor * term_.kappa_) * g;
        add_products<Batch>(scaled, g, symmetric, blocks);
      }
    }
    void add_to_lane(double factor, bool symmetric, int lane, ElementBlocks<E::kNodes>& blocks) const {
      for (const Columns& all : gradient_) {
        const NodeDifferences<E::kNodes> g = lane_of_matrix(all, lane);
        add_products<double>(NodeDifferences<E::kNodes>(factor * term_.kappa_ * g), g, symmetric, blocks);
      }
    }

   private:
    Mat3T<Batch> curvature(int p) const {
      return term_.projection_.at(b_, p, stress_) * volume_.at[static_cast<std::size_t>(p)].curvature;
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
    Coefficients stress_;
    std::array<Columns, static_cast<std::size_t>(kTerms)> gradient_;  // g_i at nodes 1, 2, ...
    bool has_curvature_;
  };

  double kappa_;  // Pa
  VolumeProjection<E> projection_;
};

}  // namespace orthodyn
