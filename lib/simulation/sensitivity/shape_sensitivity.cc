#include "lib/simulation/sensitivity/shape_sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lib/simulation/sensitivity/changed_models.h"
#include "lib/simulation/sensitivity/nelson_system.h"
#include "lib/simulation/sensitivity/stiffness_product.h"

namespace orthodyn {

namespace {

// One more mode, because the last one may have the frequency of the next.
Modes with_the_next(const FemModel& model, const State& rest, const Modes& modes) {
  const auto count = static_cast<int>(modes.modes.size());
  return count < model.num_dofs() ? natural_modes(model, rest, count + 1) : modes;
}

// Why a shape has no derivative; "" if it has one.
std::string obstacle(const Modes& all, std::size_t k) {
  constexpr double kEqual = 1e-6;  // relative difference of omega^2, above its rounding errors
  const double lambda = all.modes[k].lambda;
  if (static_cast<int>(k) < all.zeros) return "its frequency is 0 Hz, so that its shape is not unique";
  if (!(lambda > 0)) return "it is unstable";
  const auto equals = [&](std::size_t other) { return std::abs(all.modes[other].lambda - lambda) < kEqual * lambda; };
  for (const std::size_t other : {k - 1, k + 1})
    if (other < all.modes.size() && equals(other))
      return fmt::format("its frequency equals that of mode {}, so that its shape is not unique", other + 1);
  return "";
}

// dK/dp phi and dM/dp phi of all modes, one per column.
struct Slopes {
  Eigen::MatrixXd stiffness, mass;
};

Slopes slopes_of(const ChangedModels& changed_models, double t, const Modes& modes, double small) {
  const auto count = static_cast<Eigen::Index>(modes.modes.size());
  const Eigen::Index n = modes.modes.front().shape.size();
  const auto product = [&](const auto& times) {
    return changed_models.derivative([&](const ChangedModels::Changed& changed) {
      const auto structure = without_loads(changed.model());
      Eigen::MatrixXd products(n, count);
      for (Eigen::Index k = 0; k < count; ++k)
        products.col(k) = times(*structure, modes.modes[static_cast<std::size_t>(k)].shape);
      return products;
    });
  };
  return {product([&](const Model& model, const Vector& shape) {
            return stiffness_times(model, t, Vector::Zero(n), shape, small);
          }),
          product([&](const Model& model, const Vector& shape) {
            Vector inertia(n);
            model.multiply_mass(shape, inertia);
            return inertia;
          })};
}

Vector derivative(NelsonSystem& system, const FemModel& model, const Mode& mode, const Vector& stiffness_slope,
                  const Vector& mass_slope) {
  Vector inertia(mode.shape.size()), inertia_of_z(mode.shape.size());
  model.multiply_mass(mode.shape, inertia);
  const Vector unbalanced = stiffness_slope - mode.lambda * mass_slope;
  const double lambda_slope = mode.shape.dot(unbalanced) / mode.shape.dot(inertia);
  const Vector z = system.solve(lambda_slope * inertia - unbalanced);
  model.multiply_mass(z, inertia_of_z);
  return z - (mode.shape.dot(inertia_of_z) + mode.shape.dot(mass_slope) / 2) * mode.shape;
}

}  // namespace

ShapeSensitivities shape_sensitivities(const Config& scene, const FemModel& model, const State& rest,
                                       const Modes& modes, const std::vector<SceneParameter>& parameters) {
  ShapeSensitivities out;
  if (parameters.empty() || modes.modes.empty()) return out;
  const Modes all = with_the_next(model, rest, modes);
  for (std::size_t k = 0; k < modes.modes.size(); ++k) out.missing.push_back(obstacle(all, k));
  std::vector<Slopes> slopes;
  for (const SceneParameter& parameter : parameters) {
    slopes.push_back(slopes_of(ChangedModels(scene, model, parameter), rest.t, modes, small_displacement(model)));
    out.by_parameter.push_back({parameter, std::vector<Vector>(modes.modes.size())});
  }
  const Pattern& pattern = model.pattern();
  Linearization at;
  const auto structure = without_loads(model);
  structure->linearize(rest.t, rest.q, Vector::Zero(rest.q.size()), TangentKind::exact, at);
  std::vector<double> K(pattern.row.size()), M(pattern.row.size());
  structure->combine({0, 0, 1}, at, K.data());
  structure->combine({1, 0, 0}, at, M.data());
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    if (!out.missing[k].empty()) continue;
    const Mode& mode = modes.modes[k];
    NelsonSystem system(pattern, K, M, mode.lambda, mode.shape);
    const auto column = static_cast<Eigen::Index>(k);
    for (std::size_t p = 0; p < parameters.size(); ++p)
      out.by_parameter[p].derivatives[k] =
          derivative(system, model, mode, slopes[p].stiffness.col(column), slopes[p].mass.col(column));
  }
  return out;
}

}  // namespace orthodyn
