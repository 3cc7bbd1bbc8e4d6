// Lengths that do not go with the body: its own size, and points that are far outside of it.
#include <fmt/format.h>

#include "lib/simulation/slips/subject.h"

namespace orthodyn::slip {

namespace {

constexpr double kFar = 0.01;      // of the body's diagonal
constexpr double kHuge = 80;       // m
constexpr double kTiny = 1e-6;     // m

void add_size_slip(const Subject& subject, Warnings& out) {
  const Config mesh = subject.config.at("mesh");
  const bool huge = subject.extent > kHuge;
  if (!huge && subject.extent > kTiny) return;
  const std::string remedy = mesh.has("file") ? "mesh.scale converts it: 0.001 for mm" : "such as [25 mm, 2 cm, 1 m]";
  out.push_back(fmt::format("{}: the body is {:.4g} m long: lengths are in m; is it meant in {}? ({})", mesh.where(),
                            subject.extent, huge ? "mm" : "another unit, or scaled twice", remedy));
}

}  // namespace

void add_place_slips(const Subject& subject, Warnings& out) {
  add_size_slip(subject, out);
  const TetMesh& mesh = subject.built.model->parts().mesh;
  const auto check = [&](const Config& place, const std::string& what, const Vec3& point) {
    const double outside = distance(point, subject.box);
    if (outside <= kFar * subject.box.diagonal()) return;
    const std::string body = fmt::format("the body is {:.3g} m long", subject.extent);
    out.push_back(fmt::format("{}: {} is {:.3g} m outside of the body, at {}: the nearest node, {}, is taken; {}. Is "
                              "the point in m, and in the coordinates of the mesh?",
                              place.where(), what, outside, Value<Vec3>::yaml(point),
                              Value<Vec3>::yaml(mesh.nodes[static_cast<std::size_t>(nearest_node(mesh, point))]),
                              body));
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

}  // namespace orthodyn::slip
