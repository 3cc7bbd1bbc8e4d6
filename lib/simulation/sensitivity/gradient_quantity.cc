#include "lib/simulation/sensitivity/gradient_quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/errors.h"
#include "lib/core/spelling.h"
#include "lib/mesh/selection.h"

namespace orthodyn {

namespace {

[[noreturn]] void refuse(const std::string& quantity, const std::string& reason) {
  throw ConfigError(quantity, reason +
                                  "; a gradient is of PROBE.displacement.x, .y or .z, of PROBE.velocity.x, .y or .z, "
                                  "or of GAUGE.length or GAUGE.strain. Derivatives of other quantities: sensitivities "
                                  "in the scene");
}

// The quantity's name without the name of the probe or gauge at its start; "" if another probe or gauge is named.
std::string field_of(const std::string& quantity, const std::string& name) {
  return quantity.starts_with(name + ".") ? quantity.substr(name.size() + 1) : "";
}

}  // namespace

GradientQuantity::GradientQuantity(const std::string& name, const Scene& scene, const FemModel& model) : model_(model) {
  std::vector<std::string> known;
  for (const auto& [gauge_name, gauge] : scene.output.gauges) {
    known.push_back(gauge_name);
    const std::string rest = field_of(name, gauge_name);
    if (rest.empty()) continue;
    const auto wanted = find_gauge_value(rest);
    if (!wanted) refuse(name, fmt::format("'{}' is no quantity of a gauge", rest));
    gauge_.emplace(gauge, model.parts().mesh);
    of_gauge_ = *wanted;
    unit_ = kGaugeValues[static_cast<std::size_t>(*wanted)].second;
    return;
  }
  for (const auto& [probe_name, probe] : scene.output.probes) {
    known.push_back(probe_name);
    const std::string rest = field_of(name, probe_name);
    if (rest.empty()) continue;
    const auto dot = rest.find('.');
    const std::string field = rest.substr(0, dot), component = dot == std::string::npos ? "" : rest.substr(dot + 1);
    const std::string axes = "xyz";
    if ((field != "displacement" && field != "velocity") || component.size() != 1 ||
        axes.find(component) == std::string::npos)
      refuse(name, fmt::format("'{}' is no such quantity", rest));
    const int node = probe.node(model.parts().mesh);
    unknown_ = model.parts().dofs->node(node)[axes.find(component)];
    if (model.parts().dofs->ties().is_tied(node))
      refuse(name,
             "the nearest node is tied to another surface; move the probe to a node of that surface or away from it");
    if (unknown_ < 0) refuse(name, "this coordinate is held or moved by a support");
    is_velocity_ = field == "velocity";
    if (is_velocity_ && scene.is_static()) refuse(name, "the scene is static and has no velocity");
    unit_ = is_velocity_ ? "m/s" : "m";
    return;
  }
  refuse(name, known.empty() ? "the scene has no probes or gauges"
                             : fmt::format("the scene has no such probe or gauge; it has {}", join(known)));
}

double GradientQuantity::value(const State& state) const {
  if (gauge_) return gauge_->value(of_gauge_, ObservedState(model_, state));
  return is_velocity_ ? state.v[unknown_] : state.q[unknown_];
}

std::optional<double> GradientQuantity::size(const State& state) const {
  constexpr double kSmallest = 1e-8;  // strain
  if (!gauge_) return std::nullopt;
  const double strain = std::max(std::abs(gauge_->value(GaugeValue::strain, ObservedState(model_, state))), kSmallest);
  return of_gauge_ == GaugeValue::strain ? strain : strain * gauge_->length_at_rest();
}

void GradientQuantity::derivatives(const State& state, VectorRef by_position, VectorRef by_velocity) const {
  by_position.setZero();
  by_velocity.setZero();
  if (!gauge_) {
    (is_velocity_ ? by_velocity : by_position)[unknown_] = 1;
    return;
  }
  for (const auto& [node, slope] : gauge_->by_displacements(of_gauge_, ObservedState(model_, state)))
    model_.parts().dofs->ties().for_each_leader(node, [&, &of_node = slope](int leader, double weight) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (const int unknown = model_.parts().dofs->node(leader)[axis]; unknown >= 0)
          by_position[unknown] += weight * of_node[static_cast<Eigen::Index>(axis)];
    });
}

double GradientQuantity::explicit_derivative(const Config& config, const SceneParameter& parameter, const State& state,
                                             ChangedMotion motion) const {
  const bool moves_points = parameter.path().starts_with("mesh.") || parameter.path().starts_with("motions.");
  if (!gauge_ || !moves_points) return 0;
  const ChangedModels changed_models(config, model_, parameter, ChangeCount::two, motion);
  return changed_models.derivative([&](const ChangedModels::Changed& changed) {
    const ObservedState observed(changed.model(), state);
    return gauge_->in(changed.model().parts().mesh).value(of_gauge_, observed);
  });
}

}  // namespace orthodyn
