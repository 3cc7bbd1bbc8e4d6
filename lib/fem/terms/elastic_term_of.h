// Elasticity compiled for one element E and one law of lib/element: forces and tangents in batches of elements, groups
// of which are worked on in parallel.
#pragma once

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <utility>

#include "lib/core/symmetric_eigen.h"
#include "lib/fem/batch_loops.h"
#include "lib/fem/elastic_region.h"
#include "lib/fem/element_batches.h"
#include "lib/fem/element_stiffness.h"
#include "lib/fem/terms/elastic_term.h"

namespace orthodyn {

template <Element E, class Law>
class ElasticTermOf final : public ElasticTerm {
 public:
  // The pattern must outlive the term, the mesh need not.
  ElasticTermOf(const ElementMesh& mesh, ElasticRegion region, const Law& law, const BlockPattern& pattern)
      : region_(std::move(region)),
        law_(law),
        pattern_(pattern),
        elements_(mesh, region_.cells, region_.axes),
        loops_(mesh, region_.cells) {
    offsets_.reserve(region_.cells.size());
    for (int k = 0; k < size(); ++k) {
      offsets_.emplace_back(elements_.nodes(k), pattern);
      if constexpr (E::kPoints > 1) {
        const int cell = region_.cells[static_cast<std::size_t>(k)];
        note_volume(k, mesh.positions(static_cast<std::size_t>(cell)));
      }
    }
  }

  std::string name() const override { return "elasticity of region " + region_.name; }

  std::string description() const override {
    return fmt::format("{}: {}, {} elements{}", name(), law(), std::max(size(), region_.elements),
                       damped() ? fmt::format(", stiffness-proportional damping of {:.6g} s", region_.beta) : "");
  }

  const ElasticRegion& definition() const override { return region_; }
  std::string law() const override { return Law::kName; }

  std::size_t bytes() const override {
    return elements_.bytes() + axes().bytes() + offsets_.capacity() * sizeof(Offsets) +
           (region_.cells.capacity() + region_.numbers.capacity()) * sizeof(int);
  }

  void add_force(const NodalState& s, NodalVector& f) const override {
    for_each_batch_point([&](int b, int p) {
      const Mat3T<Batch> H = elements_.gradients(b, p, s.u);
      Mat3T<Batch> rate;
      if (damped()) rate = elements_.gradients(b, p, s.v);
      Batch::Mask good;
      const Mat3T<Batch> P = law_.batch_stress(H, axes().batch(b, p), damped() ? &rate : nullptr, region_.beta, good);
      if (all(good)) elements_.add_forces(b, p, P, f);
      else add_forces_one_by_one(b, p, s, f);
    });
  }

  bool has_energy() const override { return Law::kHasEnergy; }

  void add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const override {
    if constexpr (Law::kHasEnergy)
      for_each_batch_point([&](int b, int p) {
        Batch::Mask good;
        const Mat3T<Batch> P = law_.batch_mean_stress(elements_.gradients(b, p, s0.u), elements_.gradients(b, p, s1.u),
                                                      axes().batch(b, p), good);
        if (all(good)) elements_.add_forces(b, p, P, f);
        else add_mean_forces_one_by_one(b, p, s0, s1, f);
      });
  }

  void add_tangent(const NodalState& s, TangentKind kind, double* K, double* D) const override {
    double* const damping = damped() ? D : nullptr;
    loops_.for_each_batch([&](int b) {
      if (!add_batch_tangent(b, s, kind, K, damping))
        loops_.for_each_of(b, [&](int k) { add_element_tangent(k, s, kind, K, damping); });
    });
  }

  void add_mixed_tangent(const NodalState& before, const NodalState& s, double* K) const override {
    if constexpr (requires(const Law& law, Mat3 H) { law.mixed_tangent(H, H, H); })
      loops_.for_each_element([&](int k) {
        add_element(k, K, [&](int p) {
          return law_.mixed_tangent(elements_.gradient(k, p, before.u), elements_.gradient(k, p, s.u), axes().of(k, p));
        });
      });
    else add_tangent(s, TangentKind::exact, K, nullptr);
  }

  double energy(const NodalState& s) const override {
    return integrate(
        [&](int b, int p, Batch::Mask& good) {
          return law_.batch_energy(elements_.gradients(b, p, s.u), axes().batch(b, p), good);
        },
        [&](int k, int p) { return law_.template energy<double>(elements_.gradient(k, p, s.u), axes().of(k, p)); });
  }

  double dissipation(const NodalState& s) const override {
    if (!damped()) return 0;
    return integrate(
        [&](int b, int p, Batch::Mask& good) {
          return law_.batch_dissipation(elements_.gradients(b, p, s.u), axes().batch(b, p),
                                        elements_.gradients(b, p, s.v), region_.beta, good);
        },
        [&](int k, int p) {
          return law_.dissipation(elements_.gradient(k, p, s.u), axes().of(k, p), elements_.gradient(k, p, s.v),
                                  region_.beta);
        });
  }

  int size() const override { return static_cast<int>(region_.cells.size()); }
  int cell(int k) const override {
    return (region_.numbers.empty() ? region_.cells : region_.numbers)[static_cast<std::size_t>(k)];
  }

  int num_points() const override { return E::kPoints; }

  Mat3 small_strain(int k, int p, const NodalVector& u) const override {
    return orthodyn::small_strain<double>(elements_.gradient(k, p, u), axes().of(k, p));
  }

  Eigen::Matrix<double, 6, Eigen::Dynamic> strains(const NodalState& s) const override {
    Eigen::Matrix<double, 6, Eigen::Dynamic> out(6, size() * E::kPoints);
    for_each_batch_point([&](int b, int p) {
      Batch::Mask good;
      const auto all_lanes =
          voigt_strain<Batch>(law_.batch_strain(elements_.gradients(b, p, s.u), axes().batch(b, p), good));
      for (int l = 0; l < elements_.lanes(b); ++l) {
        const int k = b * Batch::kLanes + l;
        auto own = out.col(k * E::kPoints + p);
        if (!good[l]) own = voigt_strain<double>(observe_point(k, p, s).strain);
        else
          for (int i = 0; i < 6; ++i) own[i] = all_lanes[i][l];
      }
    });
    return out;
  }

  double largest_green_strain(const NodalState& s) const override {
    const auto smallest = loops_.smallest([&](int b) {
      double largest = 0;
      for (int p = 0; p < E::kPoints; ++p) largest = std::max(largest, largest_square(b, p, s));
      return -largest;
    });
    return smallest.batch < 0 ? 0 : 0.5 * std::sqrt(-smallest.value);
  }

  PointObservation observe_point(int k, int p, const NodalState& s) const override {
    return law_.observe(elements_.gradient(k, p, s.u), axes().of(k, p));
  }

  Mat3 axes_at_rest(int k, int p) const override { return axes().of(k, p); }
  Mat6 stiffness() const override { return voigt(region_.stiffness); }

  double det_F(int k, const NodalState& s) const override {
    double smallest = std::numeric_limits<double>::infinity();
    for (int p = 0; p < E::kPoints; ++p)
      smallest = std::min(smallest,
                          deformation_gradient<double>(elements_.gradient(k, p, s.u), axes().of(k, p)).determinant());
    return smallest;
  }

  SmallestDetF smallest_det_F(const NodalState& s) const override {
    const auto batch = loops_.smallest([&](int b) { return smallest_determinant(b, s); });
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
    // With G = (G_1, G_2, ...) of a point and masses rho V s_a, its share V_p G^T C G of the stiffness has against the
    // share V_p / V of the mass the largest eigenvalue of C^(1/2) (sum G_a G_a^T / s_a) C^(1/2) / rho. The quotient of
    // the sums is no larger than the largest of these, times sum V_p / V where edges are curved.
    const Mat6 root = Mat6(Eigen::LLT<Mat6>(voigt(region_.stiffness)).matrixL());
    double largest = 0;
    for (int k = 0; k < size(); ++k)
      for (int p = 0; p < E::kPoints; ++p) {
        const Mat6 A = root.transpose() * strain_gram(elements_.point(k, p), E::kLumpedShares) * root;
        largest = std::max(largest, symmetric_eigenvalues(A)[5]);
      }
    return volume_excess_ * largest / density;
  }

 private:
  using Offsets = ElementOffsets<E::kNodes>;
  using Form = typename Law::Form;

  const ElementAxes& axes() const { return region_.axes; }
  bool damped() const { return region_.beta > 0; }

  // Of |F^T F - I|^2.
  ORTHODYN_FLATTEN double largest_square(int b, int p, const NodalState& s) const {
    const Mat3T<Batch> F = deformation_gradient<Batch>(elements_.gradients(b, p, s.u), axes().batch(b, p));
    Batch square(0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Batch e = Batch(i == j ? -1 : 0);
        for (int k = 0; k < 3; ++k) e = e + F(k, i) * F(k, j);
        square = square + e * e;
      }
    double largest = 0;
    for (int l = 0; l < elements_.lanes(b); ++l) largest = std::max(largest, square[l]);
    return largest;
  }

  // Of the elements of a batch, at all points; infinite where none is a number.
  double smallest_determinant(int b, const NodalState& s) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (int p = 0; p < E::kPoints; ++p) {
      const Batch all = determinants(b, p, s);
      for (int l = 0; l < elements_.lanes(b); ++l) smallest = std::min(smallest, all[l]);
    }
    return smallest;
  }

  ORTHODYN_FLATTEN Batch determinants(int b, int p, const NodalState& s) const {
    const Mat3T<Batch> F = deformation_gradient<Batch>(elements_.gradients(b, p, s.u), axes().batch(b, p));
    return F(0, 0) * (F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1)) - F(0, 1) * (F(1, 0) * F(2, 2) - F(1, 2) * F(2, 0)) +
           F(0, 2) * (F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0));
  }

  template <class Visit>
  void for_each_batch_point(Visit&& visit) const {
    loops_.for_each_batch([&](int b) {
      for (int p = 0; p < E::kPoints; ++p) visit(b, p);
    });
  }

  // The volume integral of a density given at a point of whole batches and, where those fail, of elements.
  template <class OfBatch, class OfElement>
  double integrate(OfBatch&& of_batch, OfElement&& of_element) const {
    return loops_.sum([&](int b) {
      double sum = 0;
      for (int p = 0; p < E::kPoints; ++p) {
        Batch::Mask good;
        const Batch product = elements_.volumes(b, p) * of_batch(b, p, good);
        if (all(good))
          for (int l = 0; l < Batch::kLanes; ++l) sum += product[l];
        else loops_.for_each_of(b, [&](int k) { sum += elements_.volume(k, p) * of_element(k, p); });
      }
      return sum;
    });
  }

  // The volume's mean of H, times the mean axes.
  Mat3 mean_gradient(int k, const NodalVector& u) const {
    if constexpr (E::kPoints == 1) return elements_.gradient(k, 0, u);
    Mat3 sum = Mat3::Zero();
    double volume = 0;
    for (int p = 0; p < E::kPoints; ++p) {
      sum += elements_.volume(k, p) * elements_.gradient(k, p, u) * axes().of(k, p).transpose();
      volume += elements_.volume(k, p);
    }
    return sum / volume * axes().mean(k);
  }

  void note_volume(int k, const ElementNodes<E::kNodes>& X) {
    double sum = 0;
    for (int p = 0; p < E::kPoints; ++p) sum += elements_.volume(k, p);
    volume_excess_ = std::max(volume_excess_, sum / E::mass(X, 1));
  }

  // Adds the stiffness of one element, from the forms at its points.
  template <class FormAt>
  void add_element(int k, double* values, FormAt&& form_at) const {
    ElementBlocks<E::kNodes> blocks;
    for (int p = 0; p < E::kPoints; ++p)
      add_point_stiffness<E::kNodes>(form_at(p), elements_.point(k, p), pattern_.symmetric(), p == 0, blocks);
    complete<E::kNodes>(pattern_.symmetric(), blocks);
    scatter_element(k, blocks, values);
  }

  void add_element_tangent(int k, const NodalState& s, TangentKind kind, double* K, double* D) const {
    const auto form_at = [&](int p, Form* damping) {
      return law_.tangent(elements_.gradient(k, p, s.u), axes().of(k, p), kind, region_.beta, damping);
    };
    if (D)
      add_element(k, D, [&](int p) {
        Form damping;
        form_at(p, &damping);
        return damping;
      });
    add_element(k, K, [&](int p) { return form_at(p, nullptr); });
  }

  // False, and nothing is added, if the batch has an inverted or degenerate element, or the law no batches.
  bool add_batch_tangent(int b, const NodalState& s, TangentKind kind, double* K, double* D) const {
    if constexpr (requires { typename Law::BatchForm; }) {
      ElementBlocks<E::kNodes, Batch> stiffness, damping;
      for (int p = 0; p < E::kPoints; ++p) {
        typename Law::BatchForm damping_form;
        Batch::Mask good;
        const auto form = law_.batch_tangent(elements_.gradients(b, p, s.u), axes().batch(b, p), kind, region_.beta,
                                             D ? &damping_form : nullptr, good);
        if (!all(good)) return false;
        const auto points = elements_.points(b, p);
        add_point_stiffness<E::kNodes>(form, points, pattern_.symmetric(), p == 0, stiffness);
        if (D) add_point_stiffness<E::kNodes>(damping_form, points, pattern_.symmetric(), p == 0, damping);
      }
      scatter_batch(b, stiffness, K);
      if (D) scatter_batch(b, damping, D);
      return true;
    } else {
      return false;
    }
  }

  void scatter_batch(int b, ElementBlocks<E::kNodes, Batch>& blocks, double* values) const {
    complete<E::kNodes>(pattern_.symmetric(), blocks);
    for (int l = 0; l < elements_.lanes(b); ++l) {
      const int k = b * Batch::kLanes + l;
      const auto nodes = elements_.nodes(k);
      const auto is_free = [&](int node) { return pattern_.is_free(node); };
      if (pattern_.symmetric() && std::all_of(nodes.begin(), nodes.end(), is_free)) {
        scatter_lane<E::kNodes>(blocks, l, nodes, offsets_[static_cast<std::size_t>(k)], pattern_, values);
      } else {
        ElementBlocks<E::kNodes> one;
        take_lane<E::kNodes>(blocks, pattern_.symmetric(), l, one);
        scatter_element(k, one, values);
      }
    }
  }

  void scatter_element(int k, const ElementBlocks<E::kNodes>& blocks, double* values) const {
    scatter<E::kNodes>(blocks, elements_.nodes(k), offsets_[static_cast<std::size_t>(k)], pattern_, values);
  }

  // For batches with an inverted or degenerate element.
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

  ElasticRegion region_;
  Law law_;
  const BlockPattern& pattern_;
  ElementBatches<E> elements_;
  BatchLoops loops_;
  std::vector<Offsets> offsets_;
  double volume_excess_ = 1;  // the largest ratio of the points' volumes to the element's
};

}  // namespace orthodyn
