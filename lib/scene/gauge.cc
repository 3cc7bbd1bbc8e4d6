#include "lib/scene/gauge.h"

#include <fmt/format.h>

#include "lib/mesh/mesh_point.h"
#include "lib/mesh/selection.h"

namespace orthodyn {

namespace {

Vec3 position(const MeshPoint& point, const Mesh& mesh) {
  Vec3 x = Vec3::Zero();
  for (const auto& [node, weight] : point.nodes) x += weight * mesh.node(node);
  return x;
}

void require_near_body(const char* key, const Vec3& place, const Mesh& mesh, const SourceLocation& origin) {
  constexpr double kNear = 0.02;  // of the body's diagonal
  const double distance = (position(mesh_point(mesh, place), mesh) - place).norm();
  const double limit = kNear * bounding_box(mesh).size().norm();
  if (distance > limit)
    origin.fail(
        fmt::format("{}: the point {} m is {:.3g} m away from the body, allowed are {:.3g} m (2 % of the body's "
                    "diagonal): check units and the origin of the coordinates",
                    key, Value<Vec3>::yaml(place), distance, limit));
}

}  // namespace

const Spec<Gauge>& Gauge::spec() {
  static const auto s = Spec<Gauge>()
                            .key("from", &Gauge::from, "A point of the rest shape.", {.required = true, .unit = "m"})
                            .key("to", &Gauge::to, "Another point of the rest shape.", {.required = true, .unit = "m"});
  return s;
}

std::optional<GaugeValue> find_gauge_value(const std::string& name) {
  for (std::size_t i = 0; i < kGaugeValues.size(); ++i)
    if (name == kGaugeValues[i].first) return static_cast<GaugeValue>(i);
  return std::nullopt;
}

PlacedGauge::PlacedGauge(const Gauge& gauge, const Mesh& mesh) : PlacedGauge(placed(gauge, mesh)) {
  constexpr double kSame = 1e-9;  // of the body's diagonal
  require_near_body("from", gauge.from, mesh, gauge.origin);
  require_near_body("to", gauge.to, mesh, gauge.origin);
  if (!(rest_.norm() > kSame * bounding_box(mesh).size().norm()))
    gauge.origin.fail("from and to are the same point of the body: a gauge measures the distance of two points");
}

PlacedGauge PlacedGauge::placed(const Gauge& gauge, const Mesh& mesh) {
  const MeshPoint from = mesh_point(mesh, gauge.from), to = mesh_point(mesh, gauge.to);
  PlacedGauge out;
  out.gauge_ = gauge;
  out.rest_ = position(to, mesh) - position(from, mesh);
  for (const auto& [node, weight] : to.nodes) out.weights_.emplace_back(node, weight);
  for (const auto& [node, weight] : from.nodes) out.weights_.emplace_back(node, -weight);
  std::erase_if(out.weights_, [](const auto& entry) { return entry.second == 0; });
  for (const auto& [node, weight] : out.weights_) out.places_.push_back(mesh.node(node));
  return out;
}

PlacedGauge PlacedGauge::in(const Mesh& mesh) const {
  for (std::size_t i = 0; i < weights_.size(); ++i)
    if (mesh.node(weights_[i].first) != places_[i]) return placed(gauge_, mesh);
  return *this;
}

// Displacement of `to` less that of `from`, m.
Vec3 PlacedGauge::stretch(const ObservedState& observed) const {
  Vec3 u = Vec3::Zero();
  for (const auto& [node, weight] : weights_) {
    const auto own = observed.evaluate_at("displacement", node, 3);
    u += weight * Eigen::Map<const Vec3>(own.data());
  }
  return u;
}

// |d + u| - |d| is computed as (2 d + u) . u / (|d + u| + |d|), which keeps the digits of small strains.
std::vector<double> PlacedGauge::values(const ObservedState& observed) const {
  const Vec3 u = stretch(observed);
  const double rest = rest_.norm(), now = (rest_ + u).norm();
  const double strain = (2 * rest_ + u).dot(u) / (rest * (now + rest));
  return {now, strain};
}

std::vector<std::pair<int, Vec3>> PlacedGauge::by_displacements(GaugeValue wanted,
                                                                const ObservedState& observed) const {
  const Vec3 direction = (rest_ + stretch(observed)).normalized();
  const double scale = wanted == GaugeValue::length ? 1 : 1 / rest_.norm();
  std::vector<std::pair<int, Vec3>> out;
  for (const auto& [node, weight] : weights_) out.emplace_back(node, weight * scale * direction);
  return out;
}

}  // namespace orthodyn
