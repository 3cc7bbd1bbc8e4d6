#include "lib/scene/selection.h"

#include <fmt/format.h>

#include <set>

#include "lib/scene/build.h"

namespace orthodyn {

namespace {

// `found` is a map by name; `remedy` says where such things come from.
[[noreturn]] void fail_unknown(const Origin& origin, const char* kind, const std::string& name, const auto& found,
                               const char* remedy) {
  std::vector<std::string> names;
  for (const auto& [known, members] : found) names.push_back(known);
  const auto near = nearest_name(name, names);
  origin.fail(fmt::format("the mesh has no {} '{}'{} It has {}", kind, name,
                          near.empty() ? "." : "; did you mean '" + near + "'?",
                          names.empty() ? fmt::format("none ({})", remedy) : join(names)));
}

template <class Predicate>
std::set<int> nodes_where(const TetMesh& mesh, Predicate&& inside) {
  std::set<int> out;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (inside(mesh.nodes[i])) out.insert(static_cast<int>(i));
  return out;
}

std::set<int> node_set(const TetMesh& mesh, const std::string& name, const Origin& origin) {
  const auto it = mesh.node_sets.find(name);
  if (it != mesh.node_sets.end()) return {it->second.begin(), it->second.end()};
  fail_unknown(origin, "node set", name, mesh.node_sets, "a .bou file, *NSET, physical points");
}

std::set<int> select(const Clamp& clamp, const TetMesh& mesh) {
  if (clamp.nodes) return node_set(mesh, *clamp.nodes, clamp.origin);
  if (clamp.nearest) return {nearest_node(mesh, *clamp.nearest)};
  if (clamp.surface) {
    std::set<int> out;
    for (const Triangle& t : find_surface(mesh, *clamp.surface, clamp.origin)) out.insert(t.begin(), t.end());
    return out;
  }
  if (clamp.box)
    return nodes_where(mesh, [&](const Vec3& x) {
      return (x.array() >= clamp.box->min.array()).all() && (x.array() <= clamp.box->max.array()).all();
    });
  const double tolerance = clamp.plane->tolerance.value_or(1e-6 * bounding_box(mesh).diagonal());
  const Vec3 normal = clamp.plane->normal.normalized();
  return nodes_where(mesh, [&](const Vec3& x) {
    return std::abs(normal.dot(x - clamp.plane->point)) <= tolerance;
  });
}

std::string extent(const TetMesh& mesh) {
  const Box box = bounding_box(mesh);
  return fmt::format("from {} to {}", Value<Vec3>::yaml(box.min), Value<Vec3>::yaml(box.max));
}

}  // namespace

const std::vector<Triangle>& find_surface(const TetMesh& mesh, const std::string& name, const Origin& origin) {
  const auto it = mesh.surfaces.find(name);
  if (it != mesh.surfaces.end() && !it->second.empty()) return it->second;
  fail_unknown(origin, "surface", name, mesh.surfaces, "in Gmsh, make a Physical Surface");
}

std::vector<bool> clamped_coordinates(const std::vector<Clamp>& clamps, const TetMesh& mesh) {
  std::vector<bool> clamped(3 * mesh.nodes.size(), false);
  for (const Clamp& clamp : clamps) {
    const auto nodes = select(clamp, mesh);
    if (nodes.empty())
      clamp.origin.fail("selects no node; the mesh extends " + extent(mesh) + " m");
    for (const int node : nodes)
      for (const Component c : clamp.components)
        clamped[3 * static_cast<std::size_t>(node) + static_cast<std::size_t>(c)] = true;
  }
  return clamped;
}

}  // namespace orthodyn
