// A mesh of linear or quadratic tetrahedra with regions (named groups of cells), surfaces (named groups of faces, given
// by their corners) and named node sets. Lengths in m.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "lib/core/types.h"

namespace orthodyn {

using Tet = std::array<int, 4>;       // node indices; positive volume (v1-v0) . ((v2-v0) x (v3-v0)) > 0
using Triangle = std::array<int, 3>;  // node indices

// Mid-edge nodes of a tet, and the corners of its edges, in the same order (as in VTK).
using Midsides = std::array<int, 6>;
inline constexpr std::array<std::array<std::size_t, 2>, 6> kTetEdges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

struct TetMesh {
  std::vector<Vec3> nodes;
  std::vector<Tet> tets;
  std::vector<Midsides> midsides = {};    // for each tet its mid-edge nodes; empty: linear
  std::vector<int> region_of;             // for each tet an index into region_names
  std::vector<std::string> region_names;  // at least one
  std::map<std::string, std::vector<Triangle>> surfaces;
  std::map<std::string, std::vector<int>> node_sets;  // ascending, each node once
  // For each tet the element of the file (from 0) that it was split from, ascending. Empty: no element was split.
  std::vector<int> cell_of = {};

  int order() const { return midsides.empty() ? 1 : 2; }
};

struct Box {
  Vec3 min, max;
  Vec3 size() const { return max - min; }
  double diagonal() const { return size().norm(); }
};

Box bounding_box(const TetMesh& mesh);

// Six times the signed volume of a tet, m^3.
double signed_volume6(const TetMesh& mesh, const Tet& tet);

// The mean of the corners of a tet, m.
Vec3 centroid(const TetMesh& mesh, int tet);

// The outer faces, oriented outward.
std::vector<Triangle> boundary_triangles(const TetMesh& mesh);

// Removes the marked nodes, also from node sets, and renumbers the others. Precondition: no element uses a marked node.
void remove_nodes(TetMesh& mesh, const std::vector<char>& marked);

// Names of elements, nodes and triangles for messages, such as "beam.msh:120: element 17". If a function is missing,
// the name is "<source>: element <index>". Indices are those before validate() removes anything.
struct MeshOrigin {
  std::string source;  // file or generator
  std::function<std::string(int tet)> tet_name = {};
  std::function<std::string(int node)> node_name = {};
  std::function<std::string(const std::string& surface, int triangle)> triangle_name = {};

  std::string tet(int index) const;
  std::string node(int index) const;
  std::string triangle(const std::string& surface, int index) const;
};

// Changes that were made to obtain a valid mesh, one sentence each.
using Warnings = std::vector<std::string>;

// Checks that the mesh can be used for a computation and completes it. Requires
//   at least one element, indices in range, finite coordinates;
//   no inverted or degenerate element (|6 volume| < 1e-14 longest edge^3);
//   no element folded by its curved edges (at a node, or at an integration point of stiffness or mass, det dX/dL is
//   less than 1e-6 of its value with straight edges); no elements that overlap at a common face or have different nodes
//   on a common edge; no two nodes of elements at exactly the same position (an unintended crack); no surface triangle
//   that is not a face of an element.
// Removes, with a warning, nodes that no element uses and triangles that a surface lists twice; sorts node sets;
// orients surface triangles on the boundary outward (triangles between two elements keep their orientation). Throws
// ConfigError with the name of the element.
Warnings validate(TetMesh& mesh, const MeshOrigin& origin);

}  // namespace orthodyn
