#include "lib/mesh/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "lib/core/spelling.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {

const Spec<BoxSelection>& BoxSelection::spec() {
  static const auto s = Spec<BoxSelection>()
                            .key("min", &BoxSelection::min, "Lowest coordinates.", {.required = true, .unit = "m"})
                            .key("max", &BoxSelection::max, "Highest coordinates.", {.required = true, .unit = "m"});
  return s;
}

const Spec<PlaneSelection>& PlaneSelection::spec() {
  static const auto s =
      Spec<PlaneSelection>()
          .key("point", &PlaneSelection::point, "A point of the plane.", {.required = true, .unit = "m"})
          .key("normal", &PlaneSelection::normal, "Normal of the plane, of any length.", {.required = true})
          .key("tolerance", &PlaneSelection::tolerance,
               "Largest distance of selected nodes from the plane; default 1e-6 of the mesh's diagonal.",
               {.unit = "m", .range = kNonNegative})
          .check([](const PlaneSelection& p, const Config& config) {
            if (p.normal.norm() == 0) config.at("normal").fail("is zero; give a direction");
          });
  return s;
}

int Selection::count() const {
  return surface.has_value() + box.has_value() + plane.has_value() + nearest.has_value() + nodes.has_value() +
         region.has_value();
}

void Selection::check(const Config& config) const {
  if (count() != 1) config.fail("give exactly one of surface, box, plane, nearest, nodes, region");
}

namespace {

// `found`: all existing ones, by name. `remedy`: how to create one.
[[noreturn]] void fail_unknown(const SourceLocation& origin, const char* kind, const std::string& name,
                               const auto& found, const char* remedy) {
  std::vector<std::string> names;
  for (const auto& [known, members] : found) names.push_back(known);
  origin.fail(fmt::format("the mesh has no {} '{}'{} It has {}", kind, name, did_you_mean(name, names, "."),
                          names.empty() ? fmt::format("none ({})", remedy) : join(names)));
}

template <class Predicate>
std::set<int> nodes_where(const Mesh& mesh, Predicate&& inside) {
  std::set<int> out;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (inside(mesh.nodes[i])) out.insert(static_cast<int>(i));
  return out;
}

std::set<int> node_set(const Mesh& mesh, const std::string& name, const SourceLocation& origin) {
  const auto it = mesh.node_sets.find(name);
  if (it != mesh.node_sets.end()) return {it->second.begin(), it->second.end()};
  fail_unknown(origin, "node set", name, mesh.node_sets, "a .bou file, *NSET, physical points");
}

std::set<int> nodes_of_region(const Mesh& mesh, const std::string& name, const SourceLocation& origin) {
  const auto found = std::find(mesh.region_names.begin(), mesh.region_names.end(), name);
  if (found == mesh.region_names.end())
    origin.fail(fmt::format("the mesh has no region '{}'{} It has {}", name, did_you_mean(name, mesh.region_names, "."),
                            join(mesh.region_names)));
  std::set<int> out;
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    if (mesh.region_of[cell] == found - mesh.region_names.begin())
      out.insert(mesh.cells[cell].begin(), mesh.cells[cell].end());
  return out;
}

std::set<int> select(const Selection& selection, const Mesh& mesh) {
  if (selection.region) return nodes_of_region(mesh, *selection.region, selection.origin);
  if (selection.nodes) return node_set(mesh, *selection.nodes, selection.origin);
  if (selection.nearest) return {nearest_node(mesh, *selection.nearest)};
  if (selection.surface) {
    const Cells faces = face_cells(mesh, find_surface(mesh, *selection.surface, selection.origin));
    return {faces.nodes().begin(), faces.nodes().end()};
  }
  if (selection.box) return nodes_where(mesh, [&](const Vec3& x) { return selection.box->contains(x); });
  const double tolerance = selection.plane->tolerance.value_or(1e-6 * bounding_box(mesh).diagonal());
  const Vec3 normal = selection.plane->normal.normalized();
  return nodes_where(mesh,
                     [&](const Vec3& x) { return std::abs(normal.dot(x - selection.plane->point)) <= tolerance; });
}

std::string extent(const Mesh& mesh) {
  const Box box = bounding_box(mesh);
  return fmt::format("from {} to {}", Value<Vec3>::yaml(box.min), Value<Vec3>::yaml(box.max));
}

}  // namespace

const std::vector<FaceCorners>& find_surface(const Mesh& mesh, const std::string& name, const SourceLocation& origin) {
  const auto it = mesh.surfaces.find(name);
  if (it != mesh.surfaces.end() && !it->second.empty()) return it->second;
  fail_unknown(origin, "surface", name, mesh.surfaces, "in Gmsh, make a Physical Surface");
}

std::vector<FaceCorners> surface_or_all(const Mesh& mesh, const std::optional<std::string>& name,
                                        const SourceLocation& origin) {
  return name ? find_surface(mesh, *name, origin) : boundary_faces(mesh);
}

std::vector<int> selected_nodes(const Selection& selection, const Mesh& mesh) {
  const auto nodes = select(selection, mesh);
  if (nodes.empty()) selection.origin.fail("selects no node; the mesh extends " + extent(mesh) + " m");
  return {nodes.begin(), nodes.end()};
}

int nearest_node(const Mesh& mesh, const Vec3& point) {
  const auto nearer = [&](const Vec3& a, const Vec3& b) {
    return (a - point).squaredNorm() < (b - point).squaredNorm();
  };
  return static_cast<int>(std::min_element(mesh.nodes.begin(), mesh.nodes.end(), nearer) - mesh.nodes.begin());
}

}  // namespace orthodyn
