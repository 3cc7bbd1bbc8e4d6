// Parts of the mesh in the words of the input: a set of nodes, and named surfaces.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/spec.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

struct BoxSelection {
  Vec3 min = Vec3::Zero(), max = Vec3::Zero();
  static const Spec<BoxSelection>& spec();
};
struct PlaneSelection {
  Vec3 point = Vec3::Zero(), normal{0, 0, 1};
  std::optional<double> tolerance;  // m; default 1e-6 of the mesh's diagonal
  static const Spec<PlaneSelection>& spec();
};

// A set of nodes: exactly one of the five.
struct Selection {
  std::optional<std::string> surface;
  std::optional<BoxSelection> box;
  std::optional<PlaneSelection> plane;
  std::optional<Vec3> nearest;
  std::optional<std::string> nodes;  // a node set of the mesh
  SourceLocation origin;

  int count() const;
  // Fails unless exactly one is given.
  void check(const Config& config) const;
};

// The keys of a selection, for a T that is one.
template <class T>
Spec<T> selection_spec() {
  return Spec<T>()
      .key("surface", &T::surface, "All nodes of a named surface.")
      .key("box", &T::box, "All nodes in a box (min, max).")
      .key("plane", &T::plane, "All nodes on a plane (point, normal, tolerance).")
      .key("nearest", &T::nearest, "The node nearest to a point.", {.unit = "m"})
      .key("nodes", &T::nodes, "A named node set of the mesh.");
}

// Ascending. Throws ConfigError if there are none.
std::vector<int> selected_nodes(const Selection& selection, const TetMesh& mesh);

// The node nearest to a point of the rest shape.
int nearest_node(const TetMesh& mesh, const Vec3& point);

// Throws ConfigError naming the mesh's surfaces if there is none of this name.
const std::vector<Triangle>& find_surface(const TetMesh& mesh, const std::string& name, const SourceLocation& origin);

// The same, without a name all outer faces of the body.
std::vector<Triangle> surface_or_all(const TetMesh& mesh, const std::optional<std::string>& name,
                                     const SourceLocation& origin);

}  // namespace orthodyn
