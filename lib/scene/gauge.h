// A strain gauge: the distance of two points of the body, and its engineering strain, the distance divided by that in
// the rest shape less one. The points move with the body; their displacements are interpolated within their elements.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/config/spec.h"
#include "lib/mesh/mesh.h"
#include "lib/ode/output.h"

namespace orthodyn {

struct Gauge {
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();  // m, in the rest shape
  SourceLocation origin;
  static const Spec<Gauge>& spec();
};

enum class GaugeValue { length, strain };

// Names and SI units of the values, in the order of GaugeValue.
inline constexpr std::array<std::pair<const char*, const char*>, 2> kGaugeValues{{{"length", "m"}, {"strain", "1"}}};

// A gauge on a mesh.
class PlacedGauge {
 public:
  // Throws ConfigError at the gauge's origin if a point is farther outside of the body than 2 % of its diagonal, or if
  // both points are the same point of the body. A point outside is moved onto the surface.
  PlacedGauge(const Gauge& gauge, const Mesh& mesh);

  // The gauge on a mesh with the same elements whose nodes may have other places, as in a model with another thickness.
  PlacedGauge in(const Mesh& mesh) const;

  double length_at_rest() const { return rest_.norm(); }  // m

  // Length (m) and strain.
  std::vector<double> values(const ObservedState& observed) const;
  double value(GaugeValue wanted, const ObservedState& observed) const {
    return values(observed)[static_cast<std::size_t>(wanted)];
  }

  // The derivative of a value with respect to the displacement of each node of the gauge, 1 or 1/m.
  std::vector<std::pair<int, Vec3>> by_displacements(GaugeValue wanted, const ObservedState& observed) const;

 private:
  PlacedGauge() = default;
  static PlacedGauge placed(const Gauge& gauge, const Mesh& mesh);
  Vec3 stretch(const ObservedState& observed) const;

  Gauge gauge_;
  std::vector<std::pair<int, double>> weights_;  // nodes of `to` with their weights, and of `from` with negative ones
  std::vector<Vec3> places_;                     // of these nodes in the rest shape, m
  Vec3 rest_ = Vec3::Zero();                     // from `from` to `to` in the rest shape, m
};

// Index of a value by its name; empty if there is none.
std::optional<GaugeValue> find_gauge_value(const std::string& name);

}  // namespace orthodyn
