// Lengths and directions that are probably wrong: the size of the body, distant points, and directions of axes.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/material_axes/axes_source.h"
#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kFar = 0.01;       // over the body's diagonal
constexpr double kFarNode = 0.02;   // over the body's diagonal
constexpr double kFarAnchor = 100;  // over the body's diagonal
constexpr double kHuge = 80;        // m
constexpr double kTiny = 1e-6;      // m
// A body longer than kLong with waves slower than kSlow suggests mm and MPa used as m and Pa.
constexpr double kLong = 15;       // m
constexpr double kSlow = 30;       // m/s
constexpr double kOblique = 0.02;  // cosine; directions are given to two or three digits
constexpr double kTurn = 2 * std::numbers::pi;

void check_size(const CheckContext& context, Warnings& out) {
  const Config mesh = context.config.at("mesh");
  const bool huge = context.extent > kHuge;
  if (!huge && context.extent > kLong && context.wave_speed < kSlow) {
    warn(out, mesh.where(),
         "the body is {:.4g} m long and waves in it travel at {:.3g} m/s, as in a gel: are lengths in mm and moduli in "
         "MPa? orthodyn uses m, kg, s and Pa (or units: 25 mm, 10.8 GPa)",
         context.extent, context.wave_speed);
    return;
  }
  if (!huge && context.extent > kTiny) return;
  const std::string remedy = mesh.has("file") ? "mesh.scale converts it: 0.001 for mm" : "such as [25 mm, 2 cm, 1 m]";
  warn(out, mesh.where(), "the body is {:.4g} m long: lengths are in m; is it meant in {}? ({})", context.extent,
       huge ? "mm" : "another unit, or scaled twice", remedy);
}

void check_anchor(const CheckContext& context, Warnings& out) {
  if (!context.config.has("terms")) return;
  visit_keys(context.config.at("terms"), "anchor", [&](const Config& point) {
    if (!point.is_sequence() || point.size() != 3) return;  // a key of a plugin
    const double far = distance(Value<Vec3>::read(point, {.unit = "m"}), context.box);
    if (far > kFarAnchor * context.box.diagonal())
      warn(out, point.where(), "the anchor is {:.3g} m away from a body that is {:.3g} m long: is it in m?", far,
           context.extent);
  });
}

// Checks angles of material axes only, because a support may turn several times.
void check_angle(const CheckContext& context, Warnings& out) {
  visit_keys(context.config, "axes", [&](const Config& axes) {
    visit_keys(axes, "angle", [&](const Config& angle) {
      if (!angle.is_scalar()) return;  // a key of a plugin
      const double turned = read_number(angle, {.unit = "rad"});
      if (std::abs(turned) > kTurn * (1 + 1e-9))
        warn(out, angle.where(), "{} is {:.3g} turns: is it in degrees?", angle.text(), turned / kTurn);
    });
  });
}

std::string shown_direction(const Vec3& direction) {
  const Vec3 d = direction.normalized();
  return fmt::format("[{:.3g}, {:.3g}, {:.3g}]", d[0], d[1], d[2]);
}

// Warns of a second direction that is not normal to the first.
void check_direction(const CheckContext& context, Warnings& out) {
  visit_keys(context.config, "axes", [&](const Config& axes) {
    if (!axes.is_map() || axes.has("third") || !axes.has("first") || !axes.has("second")) return;
    if (axes.has("type") && axes.at("type").text() != "directions") return;  // a key of a plugin
    const Vec3 first = Value<Vec3>::read(axes.at("first"), {}).stableNormalized();
    const Vec3 second = Value<Vec3>::read(axes.at("second"), {}).stableNormalized();
    const double overlap = first.dot(second);
    if (std::abs(overlap) <= kOblique) return;
    warn(out, axes.where(),
         "'second' is not normal to 'first' (angle {:.0f} deg): axis 2 is the part of 'second' normal to 'first', {}",
         std::acos(overlap) * 180 / std::numbers::pi, shown_direction(second - overlap * first));
  });
}

// Warns if the stiffest axis points through the thickness of a thin body of one material, because boards, strips and
// plates are not cut that way.
void check_grain(const CheckContext& context, Warnings& out) {
  constexpr double kFarStiffer = 5, kFarThinner = 2, kAlong = 0.95;
  if (context.scene.regions.size() != 1) return;
  const auto& [name, region] = *context.scene.regions.begin();
  const auto& terms = context.built.model->parts().elastic;
  if (!region.axes || !region.axes->uniform() || terms.empty()) return;
  const Mat6 C = terms.front()->stiffness();
  const Vec3 young = Mat6(C.inverse()).diagonal().head<3>().cwiseInverse();
  const Vec3 size = context.box.size();
  int grain = 0, thin = 0;
  young.maxCoeff(&grain);
  size.minCoeff(&thin);
  const int a = (grain + 1) % 3, b = (grain + 2) % 3;
  const double stiffer = young[grain] / std::max(young[a], young[b]);
  const double thinner = std::min(size[(thin + 1) % 3], size[(thin + 2) % 3]) / size[thin];
  if (!(stiffer > kFarStiffer) || !(thinner > kFarThinner)) return;
  Warnings notes;
  const Mesh& mesh = context.built.model->parts().mesh;
  const Vec3 direction = region.axes->field(mesh, notes)(centroid(mesh, 0), 0).col(grain);
  if (std::abs(direction[thin]) < kAlong) return;
  warn(out, context.config.at("regions").where(),
       "axis {}, {:.2g} times as stiff as the others, points along {}, through the thickness of the body ({:.3g} m): "
       "boards and strips usually have the grain in their plane. Are 'first' and 'second' of 'axes' as intended?",
       grain + 1, stiffer, "xyz"[thin], size[thin]);
}

void add_repeated_clamps(const CheckContext& context, Warnings& out) {
  if (!context.config.has("clamps")) return;
  const Config clamps = context.config.at("clamps");
  for (std::size_t i = 0; i < clamps.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (clamps.at(i).yaml() == clamps.at(k).yaml()) {
        warn(out, clamps.at(i).where(), "is the same clamp as clamps.{} and has no effect. Is its place wrong?", k);
        break;
      }
}

// Warns of a given centre of mass that is farther from the body than the body is long, and of given moments of inertia
// that no body of its size has.
void check_inertias(const CheckContext& context, Warnings& out) {
  const FemModel::Parts& parts = context.built.model->parts();
  for (const RigidBody& body : parts.rigid_bodies) {
    Mesh own;
    for (const int node : body.nodes()) own.nodes.push_back(parts.mesh.node(node));
    const Box box = bounding_box(own);
    for (const RigidInertia& given : body.given) {
      constexpr double kFactor = 10;
      const double radius = std::sqrt(given.principal_moments()[2] / given.mass);
      if (radius > kFactor * box.diagonal() || kFactor * kFactor * radius < box.diagonal())
        warn(out, body.place,
             "rigid: the moments of inertia of '{}' are those of a mass at {:.2g} m from its centre, and the body is "
             "{:.2g} m long: are `inertia` in kg m^2 and `mass` in kg?",
             body.name, radius, box.diagonal());
      if (const double far = distance(given.center, box); far > box.diagonal())
        warn(
            out, body.place,
            "rigid: the centre of mass, {}, is {:.3g} m outside of the body '{}', which extends from {} to {} m: is it "
            "in m, and a place in the scene at rest rather than in the body's own coordinates?",
            Value<Vec3>::yaml(given.center), far, body.name, Value<Vec3>::yaml(box.min), Value<Vec3>::yaml(box.max));
    }
  }
}

}  // namespace

void check_place(const CheckContext& context, Warnings& out) {
  check_size(context, out);
  check_anchor(context, out);
  check_angle(context, out);
  check_direction(context, out);
  check_grain(context, out);
  add_repeated_clamps(context, out);
  check_inertias(context, out);
  const Mesh& mesh = context.built.model->parts().mesh;
  const auto check = [&](const Config& place, const std::string& what, const Vec3& point) {
    const double outside = distance(point, context.box);
    if (outside <= kFar * context.box.diagonal()) {
      const Vec3& node = mesh.node(nearest_node(mesh, point));
      if (const double away = (node - point).norm(); away > kFarNode * context.box.diagonal())
        warn(out, place.where(),
             "{} is at {}, {:.3g} m away from the nearest node, {}, which is taken: give the place of a node, or use "
             "more cells",
             what, Value<Vec3>::yaml(point), away, Value<Vec3>::yaml(node));
      return;
    }
    const std::string body = fmt::format("the body is {:.3g} m long", context.extent);
    warn(out, place.where(),
         "{} is {:.3g} m outside of the body, at {}: the nearest node, {}, is taken; {}. Is the point in m, and in the "
         "coordinates of the mesh?",
         what, outside, Value<Vec3>::yaml(point), Value<Vec3>::yaml(mesh.node(nearest_node(mesh, point))), body);
  };
  for (const auto& [name, probe] : context.scene.output.probes)
    check(context.config.at("output").at("probes").at(name), fmt::format("the probe '{}'", name), probe.at);
  for (const char* section : {"clamps", "motions", "loads", "terms"}) {
    if (!context.config.has(section)) continue;
    visit_keys(context.config.at(section), "nearest", [&](const Config& point) {
      if (!point.is_sequence() || point.size() != 3) return;  // a key of a plugin
      check(point, "the point", Value<Vec3>::read(point, {.unit = "m"}));
    });
  }
}

}  // namespace orthodyn::input_checks
