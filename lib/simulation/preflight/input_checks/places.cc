// Lengths that do not go with the body: its own size, and points that are far outside of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/material_axes/axes_source.h"
#include "lib/scene/region.h"
#include "lib/simulation/preflight/input_checks/subject.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kFar = 0.01;       // of the body's diagonal
constexpr double kFarAnchor = 100;  // of the body's diagonal
constexpr double kHuge = 80;        // m
constexpr double kTiny = 1e-6;      // m
// Together those of nothing but millimetres and MPa taken for m and Pa.
constexpr double kLong = 15;       // m
constexpr double kSlow = 30;       // m/s
constexpr double kOblique = 0.02;  // cosine; directions are given by two or three digits
constexpr double kTurn = 2 * std::numbers::pi;

void check_size(const Subject& subject, Warnings& out) {
  const Config mesh = subject.config.at("mesh");
  const bool huge = subject.extent > kHuge;
  if (!huge && subject.extent > kLong && subject.wave < kSlow) {
    out.push_back(
        fmt::format("{}: the body is {:.4g} m long and waves in it travel at {:.3g} m/s, as in a gel: are "
                    "lengths in mm and moduli in MPa? orthodyn computes in m, kg, s and Pa (25 mm, 10.8 GPa)",
                    mesh.where(), subject.extent, subject.wave));
    return;
  }
  if (!huge && subject.extent > kTiny) return;
  const std::string remedy = mesh.has("file") ? "mesh.scale converts it: 0.001 for mm" : "such as [25 mm, 2 cm, 1 m]";
  out.push_back(fmt::format("{}: the body is {:.4g} m long: lengths are in m; is it meant in {}? ({})", mesh.where(),
                            subject.extent, huge ? "mm" : "another unit, or scaled twice", remedy));
}

void check_anchor(const Subject& subject, Warnings& out) {
  if (!subject.config.has("terms")) return;
  visit_keys(subject.config.at("terms"), "anchor", [&](const Config& point) {
    if (!point.is_sequence() || point.size() != 3) return;  // a plugin's own
    const double far = distance(Value<Vec3>::read(point, {.unit = "m"}), subject.box);
    if (far > kFarAnchor * subject.box.diagonal())
      out.push_back(fmt::format("{}: the anchor is {:.3g} m away from a body that is {:.3g} m long: is it in m?",
                                point.where(), far, subject.extent));
  });
}

// Of material axes; a support may make many turns.
void check_angle(const Subject& subject, Warnings& out) {
  visit_keys(subject.config, "axes", [&](const Config& axes) {
    visit_keys(axes, "angle", [&](const Config& given) {
      if (!given.is_scalar()) return;  // a plugin's own
      const double turned = read_number(given, {.unit = "rad"});
      if (std::abs(turned) > kTurn * (1 + 1e-9))
        out.push_back(
            fmt::format("{}: {} is {:.3g} turns: is it in degrees?", given.where(), given.text(), turned / kTurn));
    });
  });
}

std::string shown_direction(const Vec3& direction) {
  const Vec3 d = direction.normalized();
  return fmt::format("[{:.3g}, {:.3g}, {:.3g}]", d[0], d[1], d[2]);
}

// A second direction that is not across the first.
void check_direction(const Subject& subject, Warnings& out) {
  visit_keys(subject.config, "axes", [&](const Config& axes) {
    if (!axes.is_map() || axes.has("third") || !axes.has("first") || !axes.has("second")) return;
    if (axes.has("type") && axes.at("type").text() != "directions") return;  // a plugin's own
    const Vec3 first = Value<Vec3>::read(axes.at("first"), {}).stableNormalized();
    const Vec3 second = Value<Vec3>::read(axes.at("second"), {}).stableNormalized();
    const double overlap = first.dot(second);
    if (std::abs(overlap) <= kOblique) return;
    out.push_back(fmt::format(
        "{}: 'second' is not normal to 'first', at {:.0f} deg to it: axis 2 is its part normal "
        "to axis 1, {}",
        axes.where(), std::acos(overlap) * 180 / std::numbers::pi, shown_direction(second - overlap * first)));
  });
}

// Of a body of one material, along one direction: boards, strips and plates are not cut with the grain through them.
void check_grain(const Subject& subject, Warnings& out) {
  constexpr double kFarStiffer = 5, kFarThinner = 2, kAlong = 0.95;
  if (subject.scene.regions.size() != 1) return;
  const auto& [name, region] = *subject.scene.regions.begin();
  const auto& terms = subject.built.model->parts().elastic;
  if (!region.axes || !region.axes->uniform() || terms.empty()) return;
  const Mat6 C = voigt(material_in(subject.scene, terms.front()->region()).stiffness());
  const Vec3 young = Mat6(C.inverse()).diagonal().head<3>().cwiseInverse();
  const Vec3 size = subject.box.size();
  int grain = 0, thin = 0;
  young.maxCoeff(&grain);
  size.minCoeff(&thin);
  const int a = (grain + 1) % 3, b = (grain + 2) % 3;
  const double stiffer = young[grain] / std::max(young[a], young[b]);
  const double thinner = std::min(size[(thin + 1) % 3], size[(thin + 2) % 3]) / size[thin];
  if (!(stiffer > kFarStiffer) || !(thinner > kFarThinner)) return;
  Warnings notes;
  const TetMesh& mesh = subject.built.model->parts().mesh;
  const Vec3 direction = region.axes->field(mesh, notes)(centroid(mesh, 0), 0).col(grain);
  if (std::abs(direction[thin]) < kAlong) return;
  out.push_back(
      fmt::format("{}: axis {}, {:.2g} times as stiff as the others, points through the body, along {}, where "
                  "it is {:.3g} m thin: boards and strips have the grain along them. Are 'first' and 'second' "
                  "of 'axes' as you mean them?",
                  subject.config.at("regions").where(), grain + 1, stiffer, "xyz"[thin], size[thin]));
}

void add_repeated_clamps(const Subject& subject, Warnings& out) {
  if (!subject.config.has("clamps")) return;
  const Config clamps = subject.config.at("clamps");
  for (std::size_t i = 0; i < clamps.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (clamps.at(i).yaml() == clamps.at(k).yaml()) {
        out.push_back(fmt::format("{}: the same clamp as clamps.{}: it holds nothing more. Is it the wrong place?",
                                  clamps.at(i).where(), k));
        break;
      }
}

}  // namespace

void check_place(const Subject& subject, Warnings& out) {
  check_size(subject, out);
  check_anchor(subject, out);
  check_angle(subject, out);
  check_direction(subject, out);
  check_grain(subject, out);
  add_repeated_clamps(subject, out);
  const TetMesh& mesh = subject.built.model->parts().mesh;
  const auto check = [&](const Config& place, const std::string& what, const Vec3& point) {
    const double outside = distance(point, subject.box);
    if (outside <= kFar * subject.box.diagonal()) return;
    const std::string body = fmt::format("the body is {:.3g} m long", subject.extent);
    out.push_back(
        fmt::format("{}: {} is {:.3g} m outside of the body, at {}: the nearest node, {}, is taken; {}. Is "
                    "the point in m, and in the coordinates of the mesh?",
                    place.where(), what, outside, Value<Vec3>::yaml(point),
                    Value<Vec3>::yaml(mesh.nodes[static_cast<std::size_t>(nearest_node(mesh, point))]), body));
  };
  for (const auto& [name, probe] : subject.scene.output.probes)
    check(subject.config.at("output").at("probes").at(name), fmt::format("the probe '{}'", name), probe.at);
  for (const char* section : {"clamps", "motions", "loads", "terms"}) {
    if (!subject.config.has(section)) continue;
    visit_keys(subject.config.at(section), "nearest", [&](const Config& point) {
      if (!point.is_sequence() || point.size() != 3) return;  // a plugin's own
      check(point, "the point", Value<Vec3>::read(point, {.unit = "m"}));
    });
  }
}

}  // namespace orthodyn::input_checks
