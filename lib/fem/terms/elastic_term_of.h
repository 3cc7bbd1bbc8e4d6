// Elastic term compiled for one element type E and one law of lib/element. Forces and tangents are computed in batches
// of elements, and groups of batches in parallel.
#pragma once

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <utility>

#include "lib/core/symmetric_eigen.h"
#include "lib/fem/batch_loops.h"
#include "lib/fem/element_assembly.h"
#include "lib/fem/terms/elastic_term.h"

namespace orthodyn {

template <Element E, class Law>
class ElasticTermOf : public ElasticTerm {
 public:
  // The type and the pattern must outlive the term, the mesh need not. `rule`: the type's integration points; null if
  // the type has the points of E.
  ElasticTermOf(const ElementType& type, const ElementMesh& mesh, ElasticRegion region, const Law& law,
                const BlockPattern& pattern, const IntegrationRule* rule)
      : type_(type),
        region_(std::move(region)),
        law_(law),
        elements_(mesh, region_.cells, region_.axes, rule),
        assembly_(elements_, pattern),
        loops_(mesh, region_.cells),
        is_own_rule_(rule == nullptr) {
    if (num_points() > 1)
      for (int k = 0; k < size(); ++k) {
        const int cell = region_.cells[static_cast<std::size_t>(k)];
        note_volume(k, mesh.positions(static_cast<std::size_t>(cell)));
      }
  }
  ElasticTermOf(const ElasticTermOf&) = delete;  // assembly_ refers to elements_
  ElasticTermOf& operator=(const ElasticTermOf&) = delete;

  std::string name() const override { return "elasticity of region " + region_.name; }

  std::string description() const override {
    return fmt::format("{}: {}, {} elements{}{}", name(), law(), std::max(size(), region_.elements),
                       is_own_rule_ ? "" : fmt::format(" with {} integration points", num_points()),
                       damped() ? fmt::format(", stiffness-proportional damping of {:.6g} s", region_.beta) : "");
  }

  const ElasticRegion& definition() const override { return region_; }
  std::string law() const override { return Law::kName; }

  std::size_t bytes() const override {
    return elements_.bytes() + axes().bytes() + assembly_.bytes() +
           (region_.cells.capacity() + region_.numbers.capacity()) * sizeof(int);
  }

  void add_force(const NodalState& s, NodalVector& f) const override {
    loops_.for_each_batch([&](int b) {
      const Columns u = elements_.differences(b, s.u);
      Columns v, force;
      bool first = true;
      if (damped()) v = elements_.differences(b, s.v);
      for (int p = 0; p < num_points(); ++p) {
        Mat3T<Batch> rate;
        if (damped()) rate = elements_.gradients(b, p, v);
        Batch::Mask good;
        const Mat3T<Batch> P = law_.batch_stress(elements_.gradients(b, p, u), axes().batch(b, p),
                                                 damped() ? &rate : nullptr, region_.beta, good);
        if (all(good)) elements_.add_forces(b, p, P, std::exchange(first, false), force);
        else add_forces_one_by_one(b, p, s, f);
      }
      if (!first) elements_.scatter(b, force, f);
    });
  }

  bool has_energy() const override { return Law::kHasEnergy; }

  void add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const override {
    if constexpr (Law::kHasEnergy)
      loops_.for_each_batch([&](int b) {
        const Columns u0 = elements_.differences(b, s0.u), u1 = elements_.differences(b, s1.u);
        Columns force;
        bool first = true;
        for (int p = 0; p < num_points(); ++p) {
          Batch::Mask good;
          const Mat3T<Batch> P = law_.batch_mean_stress(elements_.gradients(b, p, u0), elements_.gradients(b, p, u1),
                                                        axes().batch(b, p), good);
          if (all(good)) elements_.add_forces(b, p, P, std::exchange(first, false), force);
          else add_mean_forces_one_by_one(b, p, s0, s1, f);
        }
        if (!first) elements_.scatter(b, force, f);
      });
  }

  void add_tangent(const NodalState& s, TangentKind kind, double* K, double* D) const override {
    add_tangents(s, kind, K, D, [](int) { return NothingElse{}; });
  }

  void add_predicted_tangent(const NodalState& before, const NodalState& s, double* K) const override {
    add_predicted_tangents(before, s, K, [](int) { return NothingElse{}; });
  }

  double energy(const NodalState& s) const override {
    return loops_.sum([&](int b) {
      const Columns u = elements_.differences(b, s.u);
      return integral(
          b,
          [&](int p, Batch::Mask& good) {
            return law_.batch_energy(elements_.gradients(b, p, u), axes().batch(b, p), good);
          },
          [&](int k, int p) { return law_.template energy<double>(elements_.gradient(k, p, s.u), axes().of(k, p)); });
    });
  }

  double dissipation(const NodalState& s) const override {
    if (!damped()) return 0;
    return loops_.sum([&](int b) {
      const Columns u = elements_.differences(b, s.u), v = elements_.differences(b, s.v);
      return integral(
          b,
          [&](int p, Batch::Mask& good) {
            return law_.batch_dissipation(elements_.gradients(b, p, u), axes().batch(b, p),
                                          elements_.gradients(b, p, v), region_.beta, good);
          },
          [&](int k, int p) {
            return law_.dissipation(elements_.gradient(k, p, s.u), axes().of(k, p), elements_.gradient(k, p, s.v),
                                    region_.beta);
          });
    });
  }

  int size() const override { return static_cast<int>(region_.cells.size()); }
  int cell(int k) const override {
    return (region_.numbers.empty() ? region_.cells : region_.numbers)[static_cast<std::size_t>(k)];
  }

  const ElementType& type() const override { return type_; }
  int num_points() const override { return elements_.num_points(); }

  Mat3 small_strain(int k, int p, const NodalVector& u) const override {
    return orthodyn::small_strain<double>(elements_.gradient(k, p, u), axes().of(k, p));
  }

  Eigen::Matrix<double, 6, Eigen::Dynamic> strains(const NodalState& s) const override {
    Eigen::Matrix<double, 6, Eigen::Dynamic> out(6, size() * num_points());
    for_each_gradient(s.u, [&](int b, int p, const Mat3T<Batch>& H) {
      Batch::Mask good;
      const auto all_lanes = voigt_strain<Batch>(law_.batch_strain(H, axes().batch(b, p), good));
      for (int l = 0; l < elements_.lanes(b); ++l) {
        const int k = b * Batch::kLanes + l;
        auto own = out.col(k * num_points() + p);
        if (!good[l]) own = voigt_strain<double>(ElasticTermOf::observe_point(k, p, s).strain);
        else
          for (int i = 0; i < 6; ++i) own[i] = all_lanes[i][l];
      }
    });
    return out;
  }

  Eigen::Matrix<double, 6, Eigen::Dynamic> stresses(const NodalState& s) const override {
    const Mat6 C = stiffness();
    Eigen::Matrix<double, 6, Eigen::Dynamic> out = strains(s);
    for (Eigen::Index i = 0; i < out.cols(); ++i) out.col(i) = (C * out.col(i)).eval();
    return out;
  }

  double largest_green_strain(const NodalState& s) const override {
    const auto smallest = smallest_of_points(s.u, [](const Mat3T<Batch>& F) { return -green_square(F); });
    return smallest.batch < 0 ? 0 : 0.5 * std::sqrt(-smallest.value);
  }

  PointObservation observe_point(int k, int p, const NodalState& s) const override {
    return law_.observe(elements_.gradient(k, p, s.u), axes().of(k, p));
  }

  std::vector<PointObservation> observe_element(int k, const NodalState& s) const override {
    std::vector<PointObservation> all;
    for (int p = 0; p < num_points(); ++p) all.push_back(ElasticTermOf::observe_point(k, p, s));
    return all;
  }

  void observe_points(const NodalState& s, const VisitPoint& visit) const override {
    for_each_gradient(s.u, [&](int b, int p, const Mat3T<Batch>& H) {
      Batch::Mask good;
      const auto all = law_.batch_observe(H, axes().batch(b, p), good);
      for (int l = 0; l < elements_.lanes(b); ++l) {
        const int k = b * Batch::kLanes + l;
        visit(k, p, good[l] ? lane_of(all, l) : ElasticTermOf::observe_point(k, p, s));
      }
    });
  }

  Mat3 axes_at_rest(int k, int p) const override { return axes().of(k, p); }

  double det_F(int k, const NodalState& s) const override {
    double smallest = std::numeric_limits<double>::infinity();
    for (int p = 0; p < num_points(); ++p)
      smallest = std::min(smallest,
                          deformation_gradient<double>(elements_.gradient(k, p, s.u), axes().of(k, p)).determinant());
    return smallest;
  }

  SmallestDetF smallest_det_F(const NodalState& s) const override {
    const auto batch = smallest_of_points(s.u, [](const Mat3T<Batch>& F) { return determinant(F); });
    SmallestDetF smallest{std::numeric_limits<double>::infinity(), -1};
    if (batch.batch < 0) return smallest;
    loops_.for_each_of(batch.batch, [&](int k) {
      if (const double d = det_F(k, s); d < smallest.value) smallest = {d, k};
    });
    return smallest;
  }

  PointObservation observe(int k, const NodalState& s) const override {
    return law_.observe(mean_gradient(k, s.u), axes().mean(k));
  }

  double max_frequency_squared(double density) const override {
    // Point p of an element has the stiffness V_p G^T C G with G = (G_1, G_2, ...) of strain_gram(), and node a the
    // mass rho V_p s_a. With C = L L^T, the largest eigenvalue of this pair is that of L^T (sum_a G_a G_a^T / s_a) L /
    // rho. The Rayleigh quotient of the element's sums over points is at most the largest of these eigenvalues, times
    // (sum_p V_p) / V if edges are curved.
    const Mat6 root = Mat6(Eigen::LLT<Mat6>(stiffness()).matrixL());
    double largest = 0;
    for (int k = 0; k < size(); ++k)
      for (int p = 0; p < num_points(); ++p) {
        const Mat6 A = root.transpose() * strain_gram(elements_.point(k, p), E::kLumpedShares) * root;
        largest = std::max(largest, symmetric_eigenvalues(A)[5]);
      }
    return volume_excess_ * largest / density;
  }

 protected:
  using Form = typename Law::Form;
  using Columns = typename ElementBatches<E>::Columns;

  const ElementAxes& axes() const { return region_.axes; }
  bool damped() const { return region_.beta > 0; }

  // What add_tangents() adds to the law's tangent in one batch: nothing. MixedElasticTermOf has another such class, for
  // the volumetric stress.
  struct NothingElse {
    static constexpr bool kIsEmpty = true;
  };

  // As add_tangent() and add_predicted_tangent(), with part_of(b) added for each batch.
  template <class PartOf>
  void add_tangents(const NodalState& s, TangentKind kind, double* K, double* D, PartOf&& part_of) const {
    double* const damping = damped() ? D : nullptr;
    loops_.for_each_batch([&](int b) {
      const auto part = part_of(b);
      if (!add_batch_tangent(b, s, kind, K, damping, part))
        loops_.for_each_of(b, [&](int k) { add_element_tangent(k, s, kind, K, damping, part); });
    });
  }

  template <class PartOf>
  void add_predicted_tangents(const NodalState& before, const NodalState& s, double* K, PartOf&& part_of) const {
    if constexpr (requires(const Law& law, Mat3 H) { law.predicted_tangent(H, H, H); })
      loops_.for_each_batch([&](int b) {
        const auto part = part_of(b);
        loops_.for_each_of(b, [&](int k) {
          add_element_stiffness(k, K, part, [&](int p) {
            return law_.predicted_tangent(elements_.gradient(k, p, before.u), elements_.gradient(k, p, s.u),
                                          axes().of(k, p));
          });
        });
      });
    else add_tangents(s, TangentKind::exact, K, nullptr, part_of);
  }

  // Mean of H over the element's volume, times the mean axes.
  Mat3 mean_gradient(int k, const NodalVector& u) const {
    if (num_points() == 1) return elements_.gradient(k, 0, u);
    Mat3 sum = Mat3::Zero();
    double volume = 0;
    for (int p = 0; p < num_points(); ++p) {
      sum += elements_.volume(k, p) * elements_.gradient(k, p, u) * axes().of(k, p).transpose();
      volume += elements_.volume(k, p);
    }
    return sum / volume * axes().mean(k);
  }

 private:
  // |F^T F - I|^2 (Frobenius norm).
  ORTHODYN_FLATTEN static Batch green_square(const Mat3T<Batch>& F) {
    Batch square(0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Batch e = Batch(i == j ? -1 : 0);
        for (int k = 0; k < 3; ++k) e = e + F(k, i) * F(k, j);
        square = square + e * e;
      }
    return square;
  }

  ORTHODYN_FLATTEN static Batch determinant(const Mat3T<Batch>& F) {
    return F(0, 0) * (F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1)) - F(0, 1) * (F(1, 0) * F(2, 2) - F(1, 2) * F(2, 0)) +
           F(0, 2) * (F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0));
  }

  // Calls visit(batch, point, H Q) for all batches and points.
  template <class Visit>
  void for_each_gradient(const NodalVector& u, Visit&& visit) const {
    loops_.for_each_batch([&](int b) {
      const Columns differences = elements_.differences(b, u);
      for (int p = 0; p < num_points(); ++p) visit(b, p, elements_.gradients(b, p, differences));
    });
  }

  // The smallest value of a function of F Q over all points and elements, and its batch.
  template <class OfF>
  BatchLoops::Smallest smallest_of_points(const NodalVector& u, OfF&& of_F) const {
    return loops_.smallest([&](int b) {
      const Columns differences = elements_.differences(b, u);
      double smallest = std::numeric_limits<double>::infinity();
      for (int p = 0; p < num_points(); ++p) {
        const Batch all = of_F(deformation_gradient<Batch>(elements_.gradients(b, p, differences), axes().batch(b, p)));
        for (int l = 0; l < elements_.lanes(b); ++l) smallest = std::min(smallest, all[l]);
      }
      return smallest;
    });
  }

  // Volume integral of a density over a batch. of_batch(p, good) gives it for all lanes, of_element(k, p) for the
  // elements of a batch whose lanes are not all good.
  template <class OfBatch, class OfElement>
  double integral(int b, OfBatch&& of_batch, OfElement&& of_element) const {
    double sum = 0;
    for (int p = 0; p < num_points(); ++p) {
      Batch::Mask good;
      const Batch product = elements_.volumes(b, p) * of_batch(p, good);
      if (all(good))
        for (int l = 0; l < Batch::kLanes; ++l) sum += product[l];
      else loops_.for_each_of(b, [&](int k) { sum += elements_.volume(k, p) * of_element(k, p); });
    }
    return sum;
  }

  void note_volume(int k, const ElementNodes<E::kNodes>& X) {
    double sum = 0;
    for (int p = 0; p < num_points(); ++p) sum += elements_.volume(k, p);
    volume_excess_ = std::max(volume_excess_, sum / (region_.share * E::mass(X, 1)));
  }

  template <class Part, class FormAt>
  void add_element_stiffness(int k, double* values, const Part& part, FormAt&& form_at) const {
    assembly_.add_element(k, values, form_at, [&](ElementBlocks<E::kNodes>& blocks) {
      if constexpr (!Part::kIsEmpty) {
        const int lane = k % Batch::kLanes;
        for (int p = 0; p < num_points(); ++p)
          part.add_curvature_of_lane(p, lane, elements_.point(k, p), assembly_.symmetric(), blocks);
        part.add_to_lane(1, assembly_.symmetric(), lane, blocks);
      }
    });
  }

  // Adds an element's matrix, and `factor` times the part's sum over points.
  template <class Part, class FormAt>
  void add_element(int k, double* values, double factor, const Part& part, FormAt&& form_at) const {
    assembly_.add_element(k, values, form_at, [&](ElementBlocks<E::kNodes>& blocks) {
      if constexpr (!Part::kIsEmpty) part.add_to_lane(factor, assembly_.symmetric(), k % Batch::kLanes, blocks);
    });
  }

  template <class Part>
  void add_element_tangent(int k, const NodalState& s, TangentKind kind, double* K, double* D, const Part& part) const {
    const auto form_at = [&](int p, Form* damping) {
      return law_.tangent(elements_.gradient(k, p, s.u), axes().of(k, p), kind, region_.beta, damping);
    };
    if (D)
      add_element(k, D, region_.beta, part, [&](int p) {
        Form damping;
        form_at(p, &damping);
        return damping;
      });
    add_element_stiffness(k, K, part, [&](int p) { return form_at(p, nullptr); });
  }

  // Returns false and adds nothing if an element of the batch is inverted or degenerate, or the law has no batch
  // version.
  template <class Part>
  bool add_batch_tangent(int b, const NodalState& s, TangentKind kind, double* K, double* D, const Part& part) const {
    if constexpr (requires { typename Law::BatchForm; }) {
      const Columns u = elements_.differences(b, s.u);
      ElementBlocks<E::kNodes, Batch> stiffness, damping;
      for (int p = 0; p < num_points(); ++p) {
        typename Law::BatchForm damping_form;
        Batch::Mask good;
        const auto form = law_.batch_tangent(elements_.gradients(b, p, u), axes().batch(b, p), kind, region_.beta,
                                             D ? &damping_form : nullptr, good);
        if (!all(good)) return false;
        const auto points = elements_.points(b, p);
        add_point_stiffness<E::kNodes>(form, points, assembly_.symmetric(), p == 0, stiffness);
        if constexpr (!Part::kIsEmpty) part.add_curvature(p, points, assembly_.symmetric(), stiffness);
        if (D) add_point_stiffness<E::kNodes>(damping_form, points, assembly_.symmetric(), p == 0, damping);
      }
      if constexpr (!Part::kIsEmpty) {
        part.add_to(1, assembly_.symmetric(), stiffness);
        if (D) part.add_to(region_.beta, assembly_.symmetric(), damping);
      }
      assembly_.add_batch(b, stiffness, K);
      if (D) assembly_.add_batch(b, damping, D);
      return true;
    } else {
      return false;
    }
  }

  // Fallback for batches with an inverted or degenerate element.
  void add_forces_one_by_one(int batch, int p, const NodalState& s, NodalVector& f) const {
    loops_.for_each_of(batch, [&](int k) {
      Mat3 rate;
      if (damped()) rate = elements_.gradient(k, p, s.v);
      elements_.add_force(k, p,
                          law_.template stress<double>(elements_.gradient(k, p, s.u), axes().of(k, p),
                                                       damped() ? &rate : nullptr, region_.beta),
                          f);
    });
  }

  void add_mean_forces_one_by_one(int batch, int p, const NodalState& s0, const NodalState& s1, NodalVector& f) const {
    loops_.for_each_of(batch, [&](int k) {
      const Mat3 H0 = elements_.gradient(k, p, s0.u), H1 = elements_.gradient(k, p, s1.u);
      elements_.add_force(k, p, law_.mean_stress(H0, H1, axes().of(k, p)), f);
    });
  }

  const ElementType& type_;
  ElasticRegion region_;

 protected:
  Law law_;
  ElementBatches<E> elements_;
  ElementAssembly<E> assembly_;
  BatchLoops loops_;

 private:
  bool is_own_rule_;          // of E
  double volume_excess_ = 1;  // max over elements of (sum of the points' volumes) / volume
};

}  // namespace orthodyn
