#include "lib/analysis/modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/core/errors.h"
#include "lib/linear/eigenmodes.h"

namespace orthodyn {

namespace {

bool has_momentum_output(const Model& model) {
  const auto outputs = model.outputs();
  return std::any_of(outputs.begin(), outputs.end(), [](const auto& info) { return info.name == "momentum.linear"; });
}

// Linear momentum for velocities equal to the mode's shape.
Vec3 participation(const Model& model, const State& about, const Vector& shape) {
  const auto momentum = model.evaluate("momentum.linear", {about.t, about.q, shape});
  return Eigen::Map<const Vec3>(momentum.data());
}

}  // namespace

void fix_sign(Vector& shape) {
  Eigen::Index k = 0;
  shape.cwiseAbs().maxCoeff(&k);
  if (shape[k] < 0) shape = -shape;
}

double Mode::angular_frequency() const { return std::copysign(std::sqrt(std::abs(lambda)), lambda); }
double Mode::frequency() const { return angular_frequency() / (2 * std::numbers::pi); }

Modes natural_modes(const Model& model, const State& about, int count) {
  if (!model.pattern().symmetric)
    throw ConfigError("elasticity", "modes need a symmetric tangent; remove elasticity.warped_tangent: unsymmetric");
  const Pattern& pattern = model.pattern();
  const auto unloaded = about.load_factor == 0 ? without_loads(model) : nullptr;
  const Model& acting = unloaded ? *unloaded : model;
  Linearization at;
  acting.linearize(about.t, about.q, Vector::Zero(about.q.size()), TangentKind::exact, at);
  std::vector<double> K(pattern.row.size()), M(pattern.row.size());
  acting.combine({0, 0, 1}, at, K.data());
  acting.combine({1, 0, 0}, at, M.data());
  EigenPairs pairs = lowest_eigenpairs(pattern, K, M, count, [&] { return model.rigid_motions(about.q); });

  const bool has_momentum = has_momentum_output(model);
  Modes out{{}, pairs.zeros, std::sqrt(pairs.resolution) / (2 * std::numbers::pi), pairs.solver};
  for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
    Mode mode{pairs.values[k], pairs.shapes.col(k)};
    fix_sign(mode.shape);
    if (has_momentum) mode.participation = participation(model, about, mode.shape);
    mode.residual = pairs.residuals[k];
    out.modes.push_back(std::move(mode));
  }
  return out;
}

Modes natural_modes_below(const Model& model, const State& about, double frequency) {
  constexpr int kFirstCount = 20;
  const double limit = std::pow(2 * std::numbers::pi * frequency, 2);
  for (int count = std::min(kFirstCount, model.num_dofs());;) {
    Modes found = natural_modes(model, about, count);
    const double reached = found.modes.back().lambda;
    if (reached >= limit || count == model.num_dofs()) return found;
    if (count >= kMostModesBelow)
      throw ConfigError(
          "", fmt::format("more than {} modes lie below {:.6g} Hz; lower the highest frequency", count, frequency));
    count = std::min({more_modes(count, reached, limit), kMostModesBelow, model.num_dofs()});
  }
}

}  // namespace orthodyn
