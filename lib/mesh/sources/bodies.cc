// The mesh source `bodies`: several meshes in one, each at its place. The bodies share no nodes, even where they touch;
// joints connect them. Regions, surfaces and node sets of a body "arm" are called arm.NAME. A region without a name of
// its own is called like its body.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lib/mesh/mesh_source.h"

namespace orthodyn {

namespace {

struct Body {
  std::shared_ptr<const MeshSource> mesh;
  Vec3 axis{0, 0, 1}, translation = Vec3::Zero();
  double angle = 0;  // rad
  SourceLocation origin;

  static const Spec<Body>& spec() {
    static const auto s =
        Spec<Body>()
            .key("mesh", &Body::mesh, "The mesh of the body, as for a scene of one body.", {.required = true})
            .key("axis", &Body::axis, "Axis of the rotation, through the origin of the body's mesh.")
            .key("angle", &Body::angle, "Angle of the rotation, before the translation.", {.unit = "rad"})
            .key("translation", &Body::translation, "Displacement of the body's mesh.", {.unit = "m"})
            .check([](const Body& body, const Config& config) {
              if (body.axis.norm() == 0) config.at("axis").fail("is zero; give a direction");
            });
    return s;
  }

  Vec3 placed(const Vec3& x) const { return Eigen::AngleAxisd(angle, axis.normalized()) * x + translation; }
};

// "arm" for the region that a mesh of one region has, "arm.NAME" for others.
std::string name_in(const std::string& body, const std::string& name, bool is_only_region) {
  return is_only_region ? body : body + "." + name;
}

void append(const std::string& name, const Body& body, const Mesh& own, Mesh& all) {
  if (!all.cells.empty() && own.order() != all.order())
    body.origin.fail(fmt::format("the elements are of order {}, those of the other bodies of order {}; set mesh.order",
                                 own.order(), all.order()));
  const auto first = static_cast<int>(all.nodes.size());
  const auto region = static_cast<int>(all.region_names.size());
  for (const Vec3& node : own.nodes) all.nodes.push_back(body.placed(node));
  for (std::size_t c = 0; c < own.cells.size(); ++c) {
    std::vector<int> nodes(own.cells[c].begin(), own.cells[c].end());
    for (int& node : nodes) node += first;
    all.cells.add(own.cells.shape(c), nodes);
    all.region_of.push_back(region + own.region_of[c]);
  }
  for (const std::string& of_region : own.region_names)
    all.region_names.push_back(name_in(name, of_region, own.region_names.size() == 1));
  for (const auto& [surface, faces] : own.surfaces)
    for (FaceCorners face : faces) {
      for (int& corner : face) corner += first;
      all.surfaces[name + "." + surface].push_back(face);
    }
  for (const auto& [set, nodes] : own.node_sets)
    for (const int node : nodes) all.node_sets[name + "." + set].push_back(first + node);
}

class Bodies : public MeshSource {
 public:
  static const Spec<Bodies>& spec() {
    static const auto s = Spec<Bodies>().key("bodies", &Bodies::bodies_, "The bodies by name.", {.required = true});
    return s;
  }

  LoadedMesh load() const override {
    LoadedMesh out;
    for (const auto& [name, body] : bodies_) {
      LoadedMesh own = body.mesh->load();
      for (std::string& warning : own.warnings) out.warnings.push_back(name + ": " + warning);
      append(name, body, own.mesh, out.mesh);
    }
    return out;
  }

 private:
  Named<Body> bodies_;
};

const bool bodies_registered = Registry<MeshSource>::add<Bodies>(
    "bodies", "Several meshes, each at its place; ties, contact, springs and joints connect them.");

}  // namespace
}  // namespace orthodyn
