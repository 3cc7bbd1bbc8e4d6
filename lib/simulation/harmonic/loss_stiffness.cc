#include "lib/simulation/harmonic/loss_stiffness.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/symmetric_eigen.h"
#include "lib/material/stiffness_contrast.h"
#include "lib/scene/build.h"
#include "lib/simulation/sensitivity/stiffness_product.h"

namespace orthodyn {

namespace {

// A material that is used for the stiffness of its loss only.
class LossMaterial : public Material {
 public:
  LossMaterial(double density, Stiffness stiffness) : stiffness_(stiffness) { density_ = density; }
  Stiffness stiffness() const override { return stiffness_; }

 private:
  Stiffness stiffness_;
};

// Loss factors of the strains 11, 22, 33, 12, 23, 31.
Vec6 factors_of(const MaterialLoss& loss) {
  if (!loss.young) return Vec6::Constant(loss.factor ? *loss.factor : 1 / *loss.quality);
  Vec6 eta;
  for (Eigen::Index i = 0; i < 3; ++i) {
    eta[i] = (*loss.young)[static_cast<std::size_t>(i)];
    eta[3 + i] = (*loss.shear)[static_cast<std::size_t>(i)];
  }
  return eta;
}

template <class C>
Stiffness scaled(const C& c, const Vec6& eta) {
  const auto mean = [&](int i, int j) { return (eta[i] + eta[j]) / 2; };
  if constexpr (std::is_same_v<C, AnisotropicStiffness>) {
    AnisotropicStiffness out = c;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) out.c(i, j) *= mean(i, j);
    return out;
  } else {
    if constexpr (C::kIsotropic)
      if ((eta.array() == eta[0]).all()) return IsotropicStiffness{eta[0] * c.lambda, eta[0] * c.mu};
    OrthotropicStiffness out = as_orthotropic(c);
    out.c11 *= eta[0], out.c22 *= eta[1], out.c33 *= eta[2];
    out.c12 *= mean(0, 1), out.c23 *= mean(1, 2), out.c31 *= mean(2, 0);
    out.g12 *= eta[3], out.g23 *= eta[4], out.g31 *= eta[5];
    return out;
  }
}

// The scene with the stiffness of the losses. Each region keeps the formulation that it has in `model`.
Scene loss_scene(const Scene& scene, const FemModel& model) {
  Scene out = scene;
  for (auto& [name, region] : out.regions) region.formulation = Formulation::displacement;
  for (const auto& term : model.parts().elastic) {
    if (!term->definition().mixed) continue;
    const std::string& name = entry_of(scene, term->definition().mesh_region).first;
    for (auto& [other, region] : out.regions)
      if (other == name) region.formulation = Formulation::mixed;
  }
  for (auto& [name, material] : out.materials) {
    Stiffness stiffness = OrthotropicStiffness{};
    for (const auto& [of, loss] : scene.harmonic->losses)
      if (of == name) stiffness = loss_of(material->stiffness(), loss);
    material = std::make_shared<LossMaterial>(material->density(), stiffness);
  }
  return out;
}

std::unique_ptr<Model> elasticity_of(const FemModel& model) {
  auto parts = model.force_parts();
  parts.resize(model.parts().elastic.size());  // the elastic parts come first
  return model.only(parts);
}

}  // namespace

Stiffness loss_of(const Stiffness& stiffness, const MaterialLoss& loss) {
  const Vec6 eta = factors_of(loss);
  const bool is_uniform = (eta.array() == eta[0]).all();
  if (!is_uniform && std::holds_alternative<IsotropicStiffness>(stiffness))
    loss.origin.fail("an isotropic material has one loss factor: give 'factor' or 'quality'");
  if (!is_uniform && is_nearly_incompressible(stiffness))
    loss.origin.fail(
        "loss factors by modulus are not available for a nearly incompressible material, whose volume strain they "
        "would "
        "damp strongly: give 'factor' or 'quality'");
  const Stiffness out = std::visit([&](const auto& c) { return scaled(c, eta); }, stiffness);
  const Vec6 values = symmetric_eigenvalues<6>(voigt(out));
  if (values[0] < -1e-12 * values[5])
    loss.origin.fail(
        "these loss factors differ so much that some strain would gain energy in a cycle; make them more alike");
  return out;
}

std::vector<double> loss_stiffness(const Scene& scene, const FemModel& model, const Vector& q) {
  if (scene.harmonic->losses.empty()) return {};
  const BuiltScene built = build(loss_scene(scene, model));
  const auto elasticity = elasticity_of(*built.model);
  Linearization at;
  elasticity->linearize(kSteadyPart, q, Vector::Zero(q.size()), TangentKind::gauss_newton, at);
  std::vector<double> values(elasticity->pattern().row.size());
  elasticity->combine({0, 0, 1}, at, values.data());
  return values;
}

Eigen::MatrixXd loss_products(const Scene& scene, const FemModel& model, const Eigen::MatrixXd& V, double small) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(V.rows(), V.cols());
  if (scene.harmonic->losses.empty()) return out;
  const BuiltScene built = build(loss_scene(scene, model));
  const auto elasticity = elasticity_of(*built.model);
  for (Eigen::Index k = 0; k < V.cols(); ++k)
    out.col(k) = stiffness_times(*elasticity, kSteadyPart, Vector::Zero(V.rows()), V.col(k), small);
  return out;
}

}  // namespace orthodyn
