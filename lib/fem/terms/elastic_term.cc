#include "lib/fem/terms/elastic_term.h"

#include <fmt/format.h>

#include <limits>

#include "lib/element/linear_law.h"
#include "lib/element/warped_law.h"
#include "lib/fem/element_batches.h"
#include "lib/fem/element_stiffness.h"

namespace orthodyn {

namespace {

template <class Law>
class Elastic final : public ElasticTerm {
 public:
  Elastic(std::string region, const TetMesh& mesh, std::vector<int> cells, const Law& law,
          const Mat6& stiffness, const ElementAxes& axes, double beta, const BlockPattern& pattern)
      : region_(std::move(region)), law_(law), C_(stiffness), axes_(axes), beta_(beta),
        cells_(std::move(cells)), pattern_(pattern), elements_(mesh, cells_, axes) {
    offsets_.reserve(cells_.size());
    for (const int cell : cells_) offsets_.emplace_back(mesh.tets[static_cast<std::size_t>(cell)], pattern);
  }

  std::string name() const override { return "elasticity of region " + region_; }

  std::string description() const override {
    return fmt::format("{}: {}, {} elements{}", name(), law(), size(),
                       beta_ > 0 ? ", stiffness-proportional damping" : "");
  }

  const std::string& region() const override { return region_; }

  std::string law() const override { return Law::kName; }

  std::size_t bytes() const override {
    return elements_.bytes() + axes_.bytes() + offsets_.capacity() * sizeof(ElementOffsets) + cells_.capacity() * sizeof(int);
  }

  void add_force(const NodalState& s, NodalVector& f) const override {
    for (int b = 0; b < elements_.num_batches(); ++b) {
      const Mat3T<Batch> F = elements_.gradients(b, s.x);
      Mat3T<Batch> rate;
      if (beta_ > 0) rate = elements_.gradients(b, s.v);
      Batch::Mask good;
      const Mat3T<Batch> P = law_.batch_stress(F, batch_axes(b), beta_ > 0 ? &rate : nullptr, beta_, good);
      if (all(good)) elements_.add_forces(b, P, f);
      else add_forces_one_by_one(b, s, f);
    }
  }

  bool has_energy() const override { return Law::kHasEnergy; }

  void add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const override {
    if constexpr (Law::kHasEnergy)
      for (int k = 0; k < size(); ++k)
        elements_.add_force(
            k, law_.mean_stress(elements_.gradient(k, s0.x), elements_.gradient(k, s1.x), axes_.of(k)), f);
  }

  void add_tangent(const NodalState& s, TangentKind kind, double* K, double* D) const override {
    const bool damped = D && beta_ > 0;
    for (int k = 0; k < size(); ++k) {
      const Tet4 shape = elements_.shape(k);
      const Tet tet = elements_.tet(k);
      const ElementOffsets& offsets = offsets_[static_cast<std::size_t>(k)];
      typename Law::Form damping;
      const typename Law::Form form =
          law_.tangent(elements_.gradient(k, s.x), axes_.of(k), kind, beta_, damped ? &damping : nullptr);
      scatter(element_stiffness(form, shape, pattern_.symmetric()), tet, offsets, pattern_, K);
      if (damped) scatter(element_stiffness(damping, shape, pattern_.symmetric()), tet, offsets, pattern_, D);
    }
  }

  double energy(const NodalState& s) const override {
    return integrate(
        [&](int b, Batch::Mask& good) { return law_.batch_energy(elements_.gradients(b, s.x), batch_axes(b), good); },
        [&](int k) { return law_.template energy<double>(elements_.gradient(k, s.x), axes_.of(k)); });
  }

  double dissipation(const NodalState& s) const override {
    if (beta_ == 0) return 0;
    return integrate(
        [&](int b, Batch::Mask& good) {
          return law_.batch_dissipation(elements_.gradients(b, s.x), batch_axes(b), elements_.gradients(b, s.v), beta_, good);
        },
        [&](int k) { return law_.dissipation(elements_.gradient(k, s.x), axes_.of(k), elements_.gradient(k, s.v), beta_); });
  }

  int size() const override { return static_cast<int>(cells_.size()); }
  int cell(int k) const override { return cells_[static_cast<std::size_t>(k)]; }

  Mat3 small_strain(int k, const NodalVector& u) const override {
    return symmetric_part<double>(axes_.of(k).transpose() * elements_.gradient(k, u));
  }

  double det_F(int k, const NodalState& s) const override { return elements_.gradient(k, s.x).determinant(); }

  PointObservation observe(int k, const NodalState& s) const override {
    return law_.observe(elements_.gradient(k, s.x), axes_.of(k));
  }

  double max_frequency_squared(double density) const override {
    // K_e = V G^T C G; with masses rho V / 4 its largest eigenvalue is that of C^(1/2) G G^T C^(1/2).
    const Mat6 root = Mat6(Eigen::LLT<Mat6>(C_).matrixL());
    double largest = 0;
    for (int k = 0; k < size(); ++k) {
      const Mat6 A = root.transpose() * strain_gram(elements_.shape(k)) * root;
      largest = std::max(largest, Eigen::SelfAdjointEigenSolver<Mat6>(A, Eigen::EigenvaluesOnly).eigenvalues()[5]);
    }
    return 4 * largest / density;
  }

 private:
  // Laws that turn with the material do not look at it: F Q has it already.
  decltype(auto) batch_axes(int b) const {
    if constexpr (Law::kBatchesNeedAxes) return axes_.batch(b);
    else return (kNotLookedAt);
  }

  template <class Visit>
  void for_each_lane(int batch, Visit&& visit) const {
    for (int l = 0; l < elements_.lanes(batch); ++l) visit(batch * Batch::kLanes + l);
  }

  // The volume integral of a density given for whole batches and, where those fail, for elements.
  template <class OfBatch, class OfElement>
  double integrate(OfBatch&& of_batch, OfElement&& of_element) const {
    double sum = 0;
    for (int b = 0; b < elements_.num_batches(); ++b) {
      Batch::Mask good;
      const Batch product = elements_.volumes(b) * of_batch(b, good);
      if (all(good)) for (int l = 0; l < Batch::kLanes; ++l) sum += product[l];
      else for_each_lane(b, [&](int k) { sum += elements_.shape(k).volume * of_element(k); });
    }
    return sum;
  }

  // For batches with an inverted or degenerate element.
  void add_forces_one_by_one(int batch, const NodalState& s, NodalVector& f) const {
    for_each_lane(batch, [&](int k) {
      Mat3 rate;
      if (beta_ > 0) rate = elements_.gradient(k, s.v);
      elements_.add_force(
          k, law_.template stress<double>(elements_.gradient(k, s.x), axes_.of(k), beta_ > 0 ? &rate : nullptr, beta_), f);
    });
  }

  static inline const Mat3 kNotLookedAt = Mat3::Identity();

  std::string region_;
  Law law_;
  Mat6 C_;  // Voigt
  ElementAxes axes_;
  double beta_;
  std::vector<int> cells_;
  const BlockPattern& pattern_;
  ElementBatches elements_;
  std::vector<ElementOffsets> offsets_;
};

}  // namespace

std::unique_ptr<ElasticTerm> make_elastic_term(const std::string& region, const TetMesh& mesh,
                                               std::vector<int> cells, const Stiffness& stiffness,
                                               const ElementAxes& axes, double beta,
                                               const ElasticityOptions& options,
                                               const BlockPattern& pattern) {
  return std::visit(
      [&](const auto& C) -> std::unique_ptr<ElasticTerm> {
        using Form = std::decay_t<decltype(C)>;
        const auto make = [&](const auto& law) -> std::unique_ptr<ElasticTerm> {
          return std::make_unique<Elastic<std::decay_t<decltype(law)>>>(
              region, mesh, std::move(cells), law, voigt(C), axes, beta, pattern);
        };
        if (options.kinematics == Kinematics::linear) return make(LinearLaw<Form>(C));
        if (options.corotation == Corotation::warped)
          return make(WarpedLaw<Form>(C, options.warped_tangent));
        return make(CorotationalLaw<Form>(C));
      },
      stiffness);
}

}  // namespace orthodyn
