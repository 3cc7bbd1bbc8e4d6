#include "lib/simulation/sensitivity/buckling_sensitivity.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "lib/analysis/prebuckling.h"
#include "lib/core/errors.h"
#include "lib/simulation/output/files.h"
#include "lib/simulation/sensitivity/changed_models.h"
#include "lib/simulation/sensitivity/stiffness_product.h"

namespace orthodyn {

namespace {

// Relative difference of load factors that count as equal; above the rounding errors of the stress stiffness.
constexpr double kEqualFactors = 1e-6;

// Number of modes from `first` on whose load factors are equal.
std::size_t cluster_at(const BucklingModes& all, std::size_t first) {
  std::size_t end = first + 1;
  const auto factor = [&](std::size_t k) { return all.modes[k].load_factor; };
  while (end < all.modes.size() && factor(end) - factor(end - 1) < kEqualFactors * factor(end)) ++end;
  return end - first;
}

// The state before buckling as a function of the parameter, linear in its change.
struct StateSlope {
  Vector unloaded, u;  // derivatives per SI unit of the parameter
};

class Sensitivity {
 public:
  Sensitivity(const Config& scene, const FemModel& model, const Vector& unloaded, double t, const BucklingModes& modes)
      : scene_(scene),
        model_(model),
        unloaded_(unloaded),
        t_(t),
        modes_(modes),
        before_(model, unloaded, t),
        small_(small_displacement(model)) {}

  // `count`: number of modes whose derivatives are wanted.
  std::vector<double> derivatives(const SceneParameter& parameter, std::size_t count) const {
    const ChangedModels changed_models(scene_, model_, parameter);
    const StateSlope slope = slope_of_state(changed_models);
    const Eigen::MatrixXd forms =
        changed_models.derivative([&](const ChangedModels::Changed& changed) { return forms_of(changed, slope); });
    std::vector<double> out(count);
    for (std::size_t first = 0, size = 0; first < count; first += size) {
      size = cluster_at(modes_, first);
      const auto at = static_cast<Eigen::Index>(first), n = static_cast<Eigen::Index>(size);
      const Eigen::VectorXd own =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(forms.block(at, at, n, n)).eigenvalues();
      for (std::size_t i = 0; i < size && first + i < count; ++i)
        out[first + i] = modes_.modes[first + i].load_factor * own[static_cast<Eigen::Index>(i)];
    }
    return out;
  }

 private:
  StateSlope slope_of_state(const ChangedModels& changed_models) const {
    const Vector still = Vector::Zero(unloaded_.size());
    StateSlope slope{still, still};
    const Vector unbalanced = changed_models.derivative([&](const ChangedModels::Changed& changed) {
      Vector force(still.size());
      without_loads(changed.model())->force(t_, unloaded_, still, force);
      return force;
    });
    before_.solver().solve(unbalanced, slope.unloaded);
    const Vector residual = changed_models.derivative([&](const ChangedModels::Changed& changed) {
      const FemModel& model = changed.model();
      const Vector at = unloaded_ + changed.change * slope.unloaded;
      Vector load(still.size());
      model.only(model.load_parts().value())->force(t_, at, still, load);
      return Vector(before_.response().times * load -
                    stiffness_times(*without_loads(model), t_, at, before_.response().u, small_));
    });
    before_.solver().solve(residual, slope.u);
    return slope;
  }

  // phi_i . (K + lambda K_g) phi_j of the modes of equal load factors, zero elsewhere.
  Eigen::MatrixXd forms_of(const ChangedModels::Changed& changed, const StateSlope& slope) const {
    const FemModel& model = changed.model();
    const auto structure = without_loads(model);
    const Vector at = unloaded_ + changed.change * slope.unloaded;
    const double times = before_.response().times;
    const MatrixValues rate =
        small_load_stiffness(model, t_, at, {before_.response().u + changed.change * slope.u, times});
    const auto n = static_cast<Eigen::Index>(modes_.modes.size());
    Eigen::MatrixXd forms = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t first = 0, size = 0; first < modes_.modes.size(); first += size) {
      size = cluster_at(modes_, first);
      const double lambda = modes_.modes[first].load_factor;
      for (std::size_t i = first; i < first + size; ++i) {
        Vector stressed(unloaded_.size());
        model.pattern().multiply(rate.data(), modes_.modes[i].shape, stressed);
        const Vector product =
            stiffness_times(*structure, t_, at, modes_.modes[i].shape, small_) + lambda / times * stressed;
        for (std::size_t j = first; j < first + size; ++j)
          forms(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = modes_.modes[j].shape.dot(product);
      }
    }
    return (forms + forms.transpose()) / 2;
  }

  const Config& scene_;
  const FemModel& model_;
  const Vector& unloaded_;
  double t_;
  const BucklingModes& modes_;
  Prebuckling before_;
  double small_;  // displacement of differences, m
};

}  // namespace

std::vector<BucklingSensitivity> buckling_sensitivities(const Config& scene, const FemModel& model,
                                                        const Vector& unloaded, double t, const BucklingModes& modes,
                                                        const std::vector<SceneParameter>& parameters) {
  std::vector<BucklingSensitivity> out;
  if (parameters.empty() || modes.modes.empty()) return out;
  if (!model.traits().smooth)
    throw ConfigError(parameters.front().path(),
                      "derivatives of load factors are not computed with contact, whose force has kinks");
  // The last of the modes may be one of several with its load factor.
  constexpr int kMore = 4;
  const auto count = static_cast<int>(modes.modes.size());
  const BucklingModes whole = buckling_modes(model, unloaded, t, std::min(count + kMore, model.num_dofs()));
  const Sensitivity sensitivity(scene, model, unloaded, t, whole);
  for (const SceneParameter& parameter : parameters)
    out.push_back({parameter, sensitivity.derivatives(parameter, modes.modes.size())});
  return out;
}

void write_sensitivities(const std::filesystem::path& folder, const BucklingModes& modes,
                         const std::vector<BucklingSensitivity>& sensitivities) {
  if (sensitivities.empty()) return;
  std::vector<std::string> header{"mode", "load_factor"};
  for (const BucklingSensitivity& one : sensitivities)
    header.push_back(fmt::format("d load_factor / d {} [1 / SI unit]", one.parameter.path()));
  CsvFile file(folder / "sensitivities.csv", header);
  file.begin();
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    std::vector<double> row{static_cast<double>(k + 1), modes.modes[k].load_factor};
    for (const BucklingSensitivity& one : sensitivities) row.push_back(one.derivatives[k]);
    file.row(row);
  }
}

}  // namespace orthodyn
