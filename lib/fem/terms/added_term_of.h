// AddedTerm compiled for one element type E.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/element/lanes.h"
#include "lib/fem/added_laws/added_law.h"
#include "lib/fem/batch_loops.h"
#include "lib/fem/element_assembly.h"
#include "lib/fem/terms/added_term.h"
#include "lib/fem/terms/elastic_term.h"

namespace orthodyn {

template <Element E>
class AddedTermOf final : public AddedTerm {
 public:
  // `rule`: as in ElasticTermOf. Other arguments as in ElementType::added_term().
  AddedTermOf(const ElementMesh& mesh, const ElasticTerm& elastic, std::unique_ptr<const AddedLaw> law,
              const BlockPattern& pattern, const IntegrationRule* rule)
      : elastic_(elastic),
        law_(std::move(law)),
        elements_(mesh, region().cells, region().axes, rule),
        assembly_(elements_, pattern),
        loops_(mesh, region().cells) {}
  AddedTermOf(const AddedTermOf&) = delete;  // assembly_ refers to elements_
  AddedTermOf& operator=(const AddedTermOf&) = delete;

  std::string name() const override { return law_->name() + " of region " + region().name; }
  std::string description() const override { return name() + law_->description().substr(law_->name().size()); }
  std::size_t bytes() const override { return elements_.bytes() + assembly_.bytes() + law_->bytes(); }
  EnergyKind energy_kind() const override { return law_->has_energy() ? EnergyKind::elastic : EnergyKind::none; }
  bool is_load() const override { return law_->is_load(); }
  bool is_dead() const override { return law_->is_dead(); }

  void add_force(const NodalState& s, NodalVector& f) const override { add_force_of(*law_at(s), s, f); }
  // Nothing for laws that are no loads.
  void add_peak_force(const NodalState& s, double end, NodalVector& f) const override {
    if (is_load()) add_force_of(*law_->at_peak(s.t, end), s, f);
  }
  double seconds_at_peak(double start, double end) const override { return law_->seconds_at_peak(start, end); }

  // For laws without an energy, the force at the middle.
  void add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const override {
    if (!law_->has_energy()) return Term::add_mean_force(s0, s1, f);
    const auto law = law_->at(0.5 * (s0.t + s1.t));
    loops_.for_each_batch([&](int b) {
      const Columns u0 = elements_.differences(b, s0.u), u1 = elements_.differences(b, s1.u);
      add_batch_force(b, f, [&](int p) {
        const Mat3T<Batch> H0 = elements_.gradients(b, p, u0), H1 = elements_.gradients(b, p, u1), Q = axes(b, p);
        return law->mean_stress({index(b, p), H0, Q}, {index(b, p), H1, Q});
      });
    });
  }

  void add_tangent(const NodalState& s, TangentKind kind, double* K, double* D) const override {
    if (is_dead()) return;
    const auto law = law_at(s);
    double* const damping = law_->depends_on_rate() ? D : nullptr;
    loops_.for_each_batch([&](int b) {
      const BatchState state(*this, b, s);
      ElementBlocks<E::kNodes, Batch> K_blocks, D_blocks;
      for (int p = 0; p < elements_.num_points(); ++p) {
        const PointState at = state.at(p);
        Mat9T<Batch> moduli = Mat9T<Batch>::Zero(), viscous = Mat9T<Batch>::Zero();
        law->add_moduli(at.point(), at.rate(), kind, moduli, damping ? &viscous : nullptr);
        const auto point = elements_.points(b, p);
        add_point_stiffness<E::kNodes>(moduli, point, assembly_.symmetric(), p == 0, K_blocks);
        if (damping) add_point_stiffness<E::kNodes>(viscous, point, assembly_.symmetric(), p == 0, D_blocks);
      }
      assembly_.add_batch(b, K_blocks, K);
      if (damping) assembly_.add_batch(b, D_blocks, damping);
    });
  }

  // |K_ab| <= V largest_modulus |g_a| |g_b| for nodes a, b at a point of volume V.
  void add_stiffness_bound(Vector& row_sums) const override {
    const double modulus = law_->largest_modulus();
    if (modulus == 0) return;
    for (int k = 0; k < elements_.size(); ++k)
      for (int p = 0; p < elements_.num_points(); ++p) {
        const auto point = elements_.point(k, p);
        Eigen::Matrix<double, E::kNodes, 1> g;
        g << point.B.colwise().sum().norm(), point.B.rowwise().norm();
        const auto nodes = elements_.nodes(k);
        for (int a = 0; a < E::kNodes; ++a)
          row_sums[nodes[static_cast<std::size_t>(a)]] += std::sqrt(3.0) * modulus * point.volume * g[a] * g.sum();
      }
  }

  double energy(const NodalState& s) const override {
    return integral(s, [](const AddedLawAt& law, const PointState& at, auto&&) { return law.energy(at.point()); });
  }
  double dissipation(const NodalState& s) const override {
    if (!law_->dissipates()) return 0;
    return integral(s, [](const AddedLawAt& law, const PointState& at, auto&& rate) {
      return law.dissipation(at.point(), rate());
    });
  }
  double load_power(const NodalState& s) const override {
    return integral(
        s, [](const AddedLawAt& law, const PointState& at, auto&& rate) { return law.power(at.point(), rate()); });
  }

  std::vector<double> breakpoints(double start, double end) const override { return law_->breakpoints(start, end); }
  StepLimits step_limits(double start, double end) const override { return law_->step_limits(start, end); }

  void visit_stresses(const NodalState& s, const VisitStress& visit) const override {
    const auto law = law_at(s, s.load_factor);
    loops_.for_each_batch([&](int b) { visit_batch(b, *law, s, visit); });
  }
  void visit_stresses_of(int k, const NodalState& s, const VisitStress& visit) const override {
    visit_batch(k / Batch::kLanes, *law_at(s, s.load_factor), s,
                [&](int other, int p, const Mat3& cauchy, const Mat3& turned) {
                  if (other == k) visit(k, p, cauchy, turned);
                });
  }
  std::string law() const override { return law_->name(); }
  bool scales_with_stiffness() const override { return law_->scales_with_stiffness(); }
  double volume(int k, int p) const override { return elements_.volume(k, p); }

  Eigen::Index num_internal() const override {
    return law_->internal() ? Eigen::Index{elements_.size()} * num_internal_of_element() : 0;
  }
  void set_first_internal(Eigen::Index first) override { first_internal_ = first; }
  void get_relaxation_times(Vector& times) const override {
    const std::vector<double> of_law = law_->internal()->relaxation_times();
    loops_.for_each_batch([&](int b) {
      for (int p = 0; p < elements_.num_points(); ++p)
        for_each_internal(
            b, p, [&](int, std::size_t branch, Eigen::Index i) { times.segment<6>(i).setConstant(of_law[branch]); });
    });
  }
  void get_strains(const NodalState& s, VectorRef strains) const override {
    const auto law = internal_law_at(s.t, {});
    for_each_strain(s, strains, [&](int, int, const PointState& at) { return law->strain(at.point()); });
  }
  void get_total_strains(const NodalState& s, VectorRef strains) const override {
    const auto law = internal_law_at(s.t, {});
    for_each_strain(s, strains, [&](int, int, const PointState& at) { return law->total_strain(at.point()); });
  }
  void get_strain_change(const NodalState& s, const NodalVector& du, VectorRef change) const override {
    const auto law = internal_law_at(s.t, {});
    for_each_strain(s, change, [&](int b, int p, const PointState& at) {
      return law->strain_change(at.point(), elements_.gradients(b, p, elements_.differences(b, du)));
    });
  }
  void add_internal_peak_force(const NodalState& s, double end, NodalVector& f) const override {
    add_force_of(*law_->at_peak(s.t, end), s, f);
  }
  void add_force_change(const NodalState& s, const Vector& change, NodalVector& f) const override {
    add_force_of(*internal_law_at(s.t, {InternalState::Kind::change, change.data(), 0}), s, f);
  }

  std::unique_ptr<AddedTerm> corotational(const ElementMesh& mesh, const BlockPattern& pattern) const override {
    return elastic_.type().added_term(mesh, elastic_, law_->corotational(), pattern);
  }

 private:
  using Columns = typename ElementBatches<E>::Columns;

  // H Q, Q and dF/dt Q at a point of a batch.
  struct PointState {
    std::size_t index;
    Mat3T<Batch> H, Q;
    std::optional<Mat3T<Batch>> F_rate;  // empty if the law does not depend on it
    LawPoint point() const { return {index, H, Q}; }
    const Mat3T<Batch>* rate() const { return F_rate ? &*F_rate : nullptr; }
  };

  class BatchState {
   public:
    BatchState(const AddedTermOf& term, int b, const NodalState& s)
        : term_(term), b_(b), u_(term.elements_.differences(b, s.u)) {
      if (term.law_->depends_on_rate()) v_ = term.elements_.differences(b, s.v);
    }
    PointState at(int p) const {
      PointState out{term_.index(b_, p), term_.elements_.gradients(b_, p, u_), term_.axes(b_, p), {}};
      if (v_) out.F_rate = term_.elements_.gradients(b_, p, *v_);
      return out;
    }

   private:
    const AddedTermOf& term_;
    int b_;
    Columns u_;
    std::optional<Columns> v_;
  };

  std::shared_ptr<const AddedLawAt> law_at(const NodalState& s, double load_factor = 1) const {
    if (!law_->internal()) return law_->at(s.t, load_factor);
    return internal_law_at(s.t, s.internal ? *s.internal : InternalState{});
  }
  std::shared_ptr<const InternalLawAt> internal_law_at(double t, const InternalState& state) const {
    return law_->internal()->at(t, {state, first_internal_, elements_.size(), elements_.num_points()});
  }

  int num_internal_of_element() const {
    return 6 * elements_.num_points() * static_cast<int>(law_->internal()->relaxation_times().size());
  }
  // Calls visit(lane, branch, i) for the first index i of the strains of each branch at point p of batch b.
  template <class Visit>
  void for_each_internal(int b, int p, Visit&& visit) const {
    const Eigen::Index branches = num_internal_of_element() / (6 * elements_.num_points());
    for (int l = 0; l < elements_.lanes(b); ++l) {
      const Eigen::Index point = (b * Batch::kLanes + l) * elements_.num_points() + p;
      for (Eigen::Index branch = 0; branch < branches; ++branch)
        visit(l, static_cast<std::size_t>(branch), first_internal_ + 6 * (point * branches + branch));
    }
  }
  // Sets the entries of all branches to strain(b, p, state of the point).
  template <class Strain>
  void for_each_strain(const NodalState& s, VectorRef out, Strain&& strain) const {
    loops_.for_each_batch([&](int b) {
      const BatchState state(*this, b, s);
      for (int p = 0; p < elements_.num_points(); ++p) {
        const Vec6T<Batch> e = strain(b, p, state.at(p));
        for_each_internal(b, p, [&](int lane, std::size_t, Eigen::Index i) {
          for (int k = 0; k < 6; ++k) out[i + k] = e[k][lane];
        });
      }
    });
  }

  const ElasticRegion& region() const { return elastic_.definition(); }
  std::size_t index(int b, int p) const { return static_cast<std::size_t>(b * elements_.num_points() + p); }
  Mat3T<Batch> axes(int b, int p) const { return region().axes.batch(b, p); }

  // stress_at(p) is P Q.
  template <class StressAt>
  void add_batch_force(int b, NodalVector& f, StressAt&& stress_at) const {
    Columns force;
    for (int p = 0; p < elements_.num_points(); ++p) elements_.add_forces(b, p, stress_at(p), p == 0, force);
    elements_.scatter(b, force, f);
  }

  void add_force_of(const AddedLawAt& law, const NodalState& s, NodalVector& f) const {
    loops_.for_each_batch([&](int b) {
      const BatchState state(*this, b, s);
      add_batch_force(b, f, [&](int p) {
        const PointState at = state.at(p);
        return law.stress(at.point(), at.rate());
      });
    });
  }

  // Volume integral of density(law, at, rate); rate() is dF/dt Q.
  template <class Density>
  double integral(const NodalState& s, Density&& density) const {
    const auto law = law_at(s, s.load_factor);
    return loops_.sum([&](int b) {
      const BatchState state(*this, b, s);
      const Columns v = elements_.differences(b, s.v);
      double sum = 0;
      for (int p = 0; p < elements_.num_points(); ++p) {
        const Batch product =
            elements_.volumes(b, p) * density(*law, state.at(p), [&] { return elements_.gradients(b, p, v); });
        for (int l = 0; l < elements_.lanes(b); ++l) sum += product[l];
      }
      return sum;
    });
  }

  template <class Visit>
  void visit_batch(int b, const AddedLawAt& law, const NodalState& s, Visit&& visit) const {
    const bool is_linear = region().options.kinematics == Kinematics::linear;
    const BatchState state(*this, b, s);
    for (int p = 0; p < elements_.num_points(); ++p) {
      const PointState at = state.at(p);
      const Mat3T<Batch> P = law.stress(at.point(), nullptr), turned = law.turned_stress(at.point());
      const Mat3T<Batch> F = is_linear ? at.Q : Mat3T<Batch>(at.Q + at.H);
      for (int l = 0; l < elements_.lanes(b); ++l)
        visit(b * Batch::kLanes + l, p, cauchy_stress(lane_of(P, l), lane_of(F, l)), lane_of(turned, l));
    }
  }

  const ElasticTerm& elastic_;
  std::unique_ptr<const AddedLaw> law_;
  ElementBatches<E> elements_;
  ElementAssembly<E> assembly_;
  BatchLoops loops_;
  Eigen::Index first_internal_ = 0;
};

}  // namespace orthodyn
