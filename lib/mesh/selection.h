// Selection of nodes and surfaces of a mesh by keys of the input.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/spec.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

struct BoxSelection {
  Vec3 min = Vec3::Zero(), max = Vec3::Zero();  // m
  SourceLocation origin;
  static const Spec<BoxSelection>& spec();
  bool contains(const Vec3& x) const { return (x.array() >= min.array()).all() && (x.array() <= max.array()).all(); }
};
struct PlaneSelection {
  Vec3 point = Vec3::Zero(), normal{0, 0, 1};
  std::optional<double> tolerance;  // m; default 1e-6 of the mesh's diagonal
  static const Spec<PlaneSelection>& spec();
};

// A set of nodes, given by exactly one of six keys.
struct Selection {
  std::optional<std::string> surface;
  std::optional<BoxSelection> box;
  std::optional<PlaneSelection> plane;
  std::optional<Vec3> nearest;
  std::optional<std::string> nodes;  // a node set of the mesh
  std::optional<std::string> region;
  SourceLocation origin;

  int count() const;
  // Throws ConfigError unless exactly one key is given.
  void check(const Config& config) const;
};

// Spec with the keys of a Selection. T is derived from Selection.
template <class T>
Spec<T> selection_spec() {
  return Spec<T>()
      .key("surface", &T::surface, "All nodes of a named surface.")
      .key("box", &T::box, "All nodes in a box (min, max).")
      .key("plane", &T::plane, "All nodes on a plane (point, normal, tolerance).")
      .key("nearest", &T::nearest, "The node nearest to a point.", {.unit = "m"})
      .key("nodes", &T::nodes, "A named node set of the mesh.")
      .key("region", &T::region, "All nodes of a region of the mesh.");
}

// Ascending node indices. Throws ConfigError if no node is selected.
std::vector<int> selected_nodes(const Selection& selection, const Mesh& mesh);

// The node nearest to a point (m) of the rest shape.
int nearest_node(const Mesh& mesh, const Vec3& point);

// The faces of a surface. Throws ConfigError, with the known names, if the mesh has no such surface.
const std::vector<FaceCorners>& find_surface(const Mesh& mesh, const std::string& name, const SourceLocation& origin);

// As find_surface(); all outer faces of the body if there is no name.
std::vector<FaceCorners> surface_or_all(const Mesh& mesh, const std::optional<std::string>& name,
                                        const SourceLocation& origin);

}  // namespace orthodyn
