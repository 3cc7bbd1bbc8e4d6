#include "lib/fem/elastic_term.h"

#include <fmt/format.h>

#include <limits>

#include "lib/element/linear_law.h"
#include "lib/element/tet4.h"
#include "lib/fem/element_stiffness.h"

namespace orthodyn {

namespace {

Mat3 edges(const NodalVector& x, const Tet& tet) {
  Mat3 e;
  for (int k = 0; k < 3; ++k) e.col(k) = x.col(tet[static_cast<std::size_t>(k) + 1]) - x.col(tet[0]);
  return e;
}

template <class Law>
class Elastic final : public ElasticTerm {
 public:
  Elastic(std::string region, const TetMesh& mesh, std::vector<int> cells, const Law& law,
          const OrthotropicStiffness& stiffness, const Mat3& Q, double beta, const BlockPattern& pattern)
      : region_(std::move(region)), law_(law), C_(stiffness), Q_(Q), beta_(beta),
        cells_(std::move(cells)), pattern_(pattern) {
    for (const int cell : cells_) {
      const Tet& tet = mesh.tets[static_cast<std::size_t>(cell)];
      Mat3 e;
      for (std::size_t k = 0; k < 3; ++k)
        e.col(static_cast<int>(k)) = mesh.nodes[static_cast<std::size_t>(tet[k + 1])] -
                                     mesh.nodes[static_cast<std::size_t>(tet[0])];
      elements_.push_back({tet, Tet4::from_edges(e, Q), ElementOffsets(tet, pattern)});
    }
  }

  std::string description() const override {
    return fmt::format("elasticity of region {}, {} elements{}", region_, size(),
                       beta_ > 0 ? ", stiffness-proportional damping" : "");
  }

  std::size_t bytes() const override {
    return elements_.capacity() * sizeof(Element) + cells_.capacity() * sizeof(int);
  }

  void add_force(const NodalState& s, NodalVector& f) const override {
    for (const Element& element : elements_) {
      const Mat3 F = element.shape.gradient(edges(s.x, element.tet));
      Mat3 P;
      if (beta_ > 0) {
        const Mat3 rate = element.shape.gradient(edges(s.v, element.tet));
        P = law_.template stress<double>(F, Q_, &rate, beta_);
      } else {
        P = law_.template stress<double>(F, Q_);
      }
      const Mat3 forces = element.shape.node_forces(P);
      for (int k = 0; k < 3; ++k) f.col(element.tet[static_cast<std::size_t>(k) + 1]) += forces.col(k);
      f.col(element.tet[0]) -= forces.rowwise().sum();
    }
  }

  void add_tangent(const NodalState& s, TangentKind kind, double* K, double* D) const override {
    for (const Element& element : elements_) {
      const Mat3 F = element.shape.gradient(edges(s.x, element.tet));
      TangentForm damping;
      const bool damped = D && beta_ > 0;
      const TangentForm form = law_.tangent(F, Q_, kind, beta_, damped ? &damping : nullptr);
      scatter(element_stiffness(form, element.shape, pattern_.symmetric()), element.tet, element.offsets,
              pattern_, K);
      if (damped)
        scatter(element_stiffness(damping, element.shape, pattern_.symmetric()), element.tet,
                element.offsets, pattern_, D);
    }
  }

  double energy(const NodalState& s) const override {
    double sum = 0;
    for (const Element& element : elements_)
      sum += element.shape.volume *
             law_.template energy<double>(element.shape.gradient(edges(s.x, element.tet)), Q_);
    return sum;
  }

  double dissipation(const NodalState& s) const override {
    if (beta_ == 0) return 0;
    double power = 0;
    const Mat3 zero = Mat3::Zero();
    for (const Element& element : elements_) {
      const Mat3 F = element.shape.gradient(edges(s.x, element.tet));
      const Mat3 rate = element.shape.gradient(edges(s.v, element.tet));
      const Mat3 viscous = law_.template stress<double>(F, Q_, &rate, beta_) -
                           law_.template stress<double>(F, Q_, &zero, 0);
      power += element.shape.volume * contract<double>(viscous, rate);
    }
    return power;
  }

  int size() const override { return static_cast<int>(cells_.size()); }
  int cell(int k) const override { return cells_[static_cast<std::size_t>(k)]; }

  double det_F(int k, const NodalState& s) const override {
    const Element& element = elements_[static_cast<std::size_t>(k)];
    return edges(s.x, element.tet).determinant() / (6 * element.shape.volume);
  }

  PointObservation observe(int k, const NodalState& s) const override {
    const Element& element = elements_[static_cast<std::size_t>(k)];
    const Mat3 F = element.shape.gradient(edges(s.x, element.tet));
    return law_.observe(F, Q_);
  }

  double max_frequency_squared(double density) const override {
    // K_e = V G^T C G; with masses rho V / 4 its largest eigenvalue is that of C^(1/2) G G^T C^(1/2).
    const Mat6 root = Mat6(Eigen::LLT<Mat6>(voigt(C_)).matrixL());
    double largest = 0;
    for (const Element& element : elements_) {
      const Mat6 GGt = strain_gram(element.shape);
      const Mat6 A = root.transpose() * GGt * root;
      largest = std::max(largest, Eigen::SelfAdjointEigenSolver<Mat6>(A, Eigen::EigenvaluesOnly).eigenvalues()[5]);
    }
    return 4 * largest / density;
  }

 private:
  struct Element {
    Tet tet;
    Tet4 shape;
    ElementOffsets offsets;
  };

  std::string region_;
  Law law_;
  OrthotropicStiffness C_;
  Mat3 Q_;
  double beta_;
  std::vector<int> cells_;
  const BlockPattern& pattern_;
  std::vector<Element> elements_;
};

}  // namespace

std::unique_ptr<ElasticTerm> make_elastic_term(const std::string& region, const TetMesh& mesh,
                                               std::vector<int> cells, const Stiffness& stiffness,
                                               const Mat3& Q, double beta,
                                               const ElasticityOptions& options,
                                               const BlockPattern& pattern) {
  return std::visit(
      [&](const auto& C) -> std::unique_ptr<ElasticTerm> {
        using Form = std::decay_t<decltype(C)>;
        const auto make = [&](const auto& law) -> std::unique_ptr<ElasticTerm> {
          return std::make_unique<Elastic<std::decay_t<decltype(law)>>>(
              region, mesh, std::move(cells), law, as_orthotropic(C), Q, beta, pattern);
        };
        if (options.kinematics == Kinematics::linear) return make(LinearLaw<Form>(C));
        if (options.corotation == Corotation::warped)
          return make(WarpedLaw<Form>(C, options.warped_tangent));
        return make(CorotationalLaw<Form>(C));
      },
      stiffness);
}

}  // namespace orthodyn
