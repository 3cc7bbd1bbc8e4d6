#include "lib/simulation/sensitivity/frequency_sensitivity.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "lib/fem/terms/added_term.h"
#include "lib/mesh/selection.h"
#include "lib/simulation/output/files.h"
#include "lib/simulation/sensitivity/changed_models.h"
#include "lib/simulation/sensitivity/stiffness_cell.h"

namespace orthodyn {

namespace {

// The modes first, ..., first + count - 1, whose frequencies are equal to round-off.
struct Cluster {
  std::size_t first, count;
};

// Groups the modes of positive frequency. Modes of equal frequency form one group.
std::vector<Cluster> clusters_of(const Modes& modes) {
  constexpr double kEqual = 1e-7;  // relative difference of omega^2, above the accuracy of the eigenvalues
  std::vector<Cluster> clusters;
  for (auto k = static_cast<std::size_t>(modes.zeros); k < modes.modes.size(); ++k) {
    const double lambda = modes.modes[k].lambda;
    if (!(lambda > 0)) continue;
    const bool continues = !clusters.empty() && clusters.back().first + clusters.back().count == k &&
                           lambda - modes.modes[k - 1].lambda < kEqual * lambda;
    if (continues) ++clusters.back().count;
    else clusters.push_back({k, 1});
  }
  return clusters;
}

// Quadratic forms of the stiffness and the mass of a model at rest.
class Forms {
 public:
  Forms(const FemModel& model, double t)
      : model_(model), rest_{t, Vector::Zero(model.num_dofs()), Vector::Zero(model.num_dofs()), 0} {
    at_rest_ = energy(rest_.q);
    small_ = kSmall * bounding_box(model.parts().mesh).size().minCoeff();
  }

  // x . K x.
  double stiffness(const Vector& x) const {
    return second_difference(x, [&](const Vector& q) { return energy(q) - at_rest_; });
  }
  // x . dK/ds x with the stiffness factor s of a cell.
  double stiffness_by(const StiffnessCell& cell, const Vector& x) const {
    return second_difference(x, [&](const Vector& q) { return cell.energy({rest_.t, q, rest_.v, 0}); });
  }
  // x . M x.
  double mass(const Vector& x) const {
    Vector product(x.size());
    model_.multiply_mass(x, product);
    return x.dot(product);
  }

 private:
  // Displacements over the smallest side of the body: the error due to large rotations is this squared.
  static constexpr double kSmall = 1e-7;

  // `energy`: 0 at rest.
  template <class Energy>
  double second_difference(const Vector& x, const Energy& energy) const {
    const double scale = small_ / std::max(x.lpNorm<Eigen::Infinity>(), std::numeric_limits<double>::min());
    const Vector q = scale * x;
    return (energy(q) + energy(-q)) / (scale * scale);
  }

  double energy(const Vector& q) const { return model_.evaluate("energy.elastic", {rest_.t, q, rest_.v, 0})[0]; }

  const FemModel& model_;
  State rest_;
  double at_rest_ = 0, small_ = 0;
};

// phi_i . A phi_j of a cluster, from the quadratic form x . A x.
template <class Form>
Eigen::MatrixXd form_of(const Modes& modes, const Cluster& cluster, const Form& of) {
  const auto n = static_cast<Eigen::Index>(cluster.count);
  const auto shape = [&](Eigen::Index i) -> const Vector& {
    return modes.modes[cluster.first + static_cast<std::size_t>(i)].shape;
  };
  Eigen::MatrixXd form(n, n);
  for (Eigen::Index i = 0; i < n; ++i) form(i, i) = of(shape(i));
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      form(i, j) = form(j, i) = (of(shape(i) + shape(j)) - of(shape(i) - shape(j))) / 4;
  return form;
}

// d/dp of phi_i . (K - omega^2 M) phi_j, with the modes and omega as they are.
class DerivativeOfForm {
 public:
  DerivativeOfForm(const Config& config, const Scene& scene, const FemModel& model, double t, const Modes& modes,
                   const SceneParameter& parameter)
      : model_(model), t_(t), modes_(modes), cell_(StiffnessCell::find(parameter.path(), scene, model)) {
    if (!cell_) changed_models_.emplace(config, model, parameter);
  }

  Eigen::MatrixXd of(const Cluster& cluster) const {
    if (cell_) {
      const Forms forms(model_, t_);
      return form_of(modes_, cluster, [&](const Vector& x) { return forms.stiffness_by(*cell_, x); });
    }
    const double lambda = modes_.modes[cluster.first].lambda;
    return changed_models_->derivative([&](const ChangedModels::Changed& changed) {
      const Forms forms(changed.model(), t_);
      return form_of(modes_, cluster, [&](const Vector& x) { return forms.stiffness(x) - lambda * forms.mass(x); });
    });
  }

 private:
  const FemModel& model_;
  double t_;
  const Modes& modes_;
  std::optional<StiffnessCell> cell_;
  std::optional<ChangedModels> changed_models_;
};

// `count`: number of modes whose derivatives are wanted; `modes` may have more.
FrequencySensitivity sensitivity(const Config& config, const Scene& scene, const FemModel& model, double t,
                                 const Modes& modes, std::size_t count, const SceneParameter& parameter) {
  const DerivativeOfForm derivative(config, scene, model, t, modes, parameter);
  FrequencySensitivity out{parameter, std::vector<double>(count, std::numeric_limits<double>::quiet_NaN())};
  for (const Cluster& cluster : clusters_of(modes)) {
    if (cluster.first >= count) break;
    const Eigen::VectorXd slopes = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(derivative.of(cluster)).eigenvalues();
    for (std::size_t i = 0; i < cluster.count && cluster.first + i < count; ++i) {
      const Mode& mode = modes.modes[cluster.first + i];
      out.derivatives[cluster.first + i] =
          slopes[static_cast<Eigen::Index>(i)] / (2 * mode.angular_frequency() * 2 * std::numbers::pi);
    }
  }
  return out;
}

// `modes`. If the last of them may be one of several with its frequency, with more modes.
Modes with_whole_clusters(const FemModel& model, const State& about, const Modes& modes) {
  constexpr int kMore = 4;
  const auto count = static_cast<int>(modes.modes.size());
  const int more = std::min(count + kMore, model.num_dofs());
  return more > count ? natural_modes(model, about, more) : modes;
}

}  // namespace

std::vector<SceneParameter> scene_parameters(const Config& scene, const std::vector<std::string>& paths) {
  std::vector<SceneParameter> parameters;
  for (const std::string& path : paths) {
    parameters.emplace_back(scene, path);
    require_changeable(scene, parameters.back());
  }
  return parameters;
}

std::vector<FrequencySensitivity> frequency_sensitivities(const Config& scene, const FemModel& model, const State& rest,
                                                          const Modes& modes,
                                                          const std::vector<SceneParameter>& parameters) {
  std::vector<FrequencySensitivity> out;
  if (parameters.empty()) return out;
  for (const auto& term : model.parts().loads)
    if (const auto* added = dynamic_cast<const AddedTerm*>(term.get());
        added && !term->is_load() && added->num_internal() == 0)
      throw ConfigError(parameters.front().path(),
                        "derivatives of natural frequencies do not exist with passive fibres, whose stiffness jumps at "
                        "rest");
  const Modes whole = with_whole_clusters(model, rest, modes);
  const Scene read = read_scene(scene);
  for (const SceneParameter& parameter : parameters)
    out.push_back(sensitivity(scene, read, model, rest.t, whole, modes.modes.size(), parameter));
  return out;
}

std::vector<FrequencySensitivity> frequency_sensitivities(const Config& scene, const ModalAnalysis& analysis,
                                                          const std::vector<SceneParameter>& parameters) {
  return frequency_sensitivities(scene, analysis.model(), analysis.about(), analysis.modes(), parameters);
}

void write_sensitivities(const std::filesystem::path& folder, const ModalAnalysis& analysis,
                         const std::vector<FrequencySensitivity>& sensitivities) {
  if (sensitivities.empty()) return;
  std::vector<std::string> header{"mode", "frequency [Hz]"};
  for (const FrequencySensitivity& one : sensitivities)
    header.push_back(fmt::format("d frequency / d {} [Hz / SI unit]", one.parameter.path()));
  CsvFile file(folder / "sensitivities.csv", header);
  file.begin();
  for (std::size_t k = 0; k < analysis.modes().modes.size(); ++k) {
    std::vector<double> row{static_cast<double>(k + 1), analysis.modes().modes[k].frequency()};
    for (const FrequencySensitivity& one : sensitivities) row.push_back(one.derivatives[k]);
    file.row(row);
  }
}

}  // namespace orthodyn
