// The quantity of a gradient: a displacement or velocity component at a probe, which is an unknown of the model, or the
// length or strain of a gauge.
#pragma once

#include <optional>
#include <string>

#include "lib/scene/gauge.h"
#include "lib/simulation/sensitivity/changed_models.h"

namespace orthodyn {

class GradientQuantity {
 public:
  // `name`: PROBE.displacement.z, PROBE.velocity.z, GAUGE.length or GAUGE.strain. Throws ConfigError for others, and
  // for a held coordinate. `model` must outlive this object.
  GradientQuantity(const std::string& name, const Scene& scene, const FemModel& model);

  const std::string& unit() const { return unit_; }  // SI; "1" if dimensionless

  double value(const State& state) const;

  // The size of a gauge's strain or of its change of length, for error control; empty for others.
  std::optional<double> size(const State& state) const;

  // The derivatives with respect to the unknowns and their velocities, which are set.
  void derivatives(const State& state, VectorRef by_position, VectorRef by_velocity) const;

  // The derivative with respect to a parameter at a fixed state: a number of the mesh or of a motion moves the points
  // of a gauge. `config`: resolved input of the scene.
  double explicit_derivative(const Config& config, const SceneParameter& parameter, const State& state,
                             ChangedMotion motion) const;

 private:
  const FemModel& model_;
  std::string unit_;
  int unknown_ = -1;  // of a probe
  bool is_velocity_ = false;
  std::optional<PlacedGauge> gauge_;
  GaugeValue of_gauge_ = GaugeValue::length;
};

}  // namespace orthodyn
