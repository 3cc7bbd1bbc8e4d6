// A mesh of linear or quadratic tetrahedra with regions (named groups of cells), surfaces (named groups of faces, by
// their corners) and named sets of nodes. Lengths in metres.
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

// The corners of a tet that its edges connect, in the order of Midsides (and of VTK).
using Midsides = std::array<int, 6>;
inline constexpr std::array<std::array<std::size_t, 2>, 6> kTetEdges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

struct TetMesh {
  std::vector<Vec3> nodes;
  std::vector<Tet> tets;
  std::vector<Midsides> midsides = {};    // of each tet the node on each edge; empty: linear tetrahedra
  std::vector<int> region_of;             // for each tet an index into region_names
  std::vector<std::string> region_names;  // at least one
  std::map<std::string, std::vector<Triangle>> surfaces;
  std::map<std::string, std::vector<int>> node_sets;  // ascending, each node once
  // For each tet the element of the file that it was cut from, counted from 0; ascending. Empty: none was cut.
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

// The outer faces, oriented outward.
std::vector<Triangle> boundary_triangles(const TetMesh& mesh);

// Removes the nodes that are marked, also from node sets, and numbers the others anew. Precondition: no element has
// one.
void remove_nodes(TetMesh& mesh, const std::vector<char>& marked);

// Where an element or a node of the mesh came from, for messages, e.g. "beam.msh:120: element 17".
// Functions may be empty: then "<source>: element <index>" and so on. Indices are those before
// validate().
struct MeshOrigin {
  std::string source;  // file or generator
  std::function<std::string(int tet)> tet_name = {};
  std::function<std::string(int node)> node_name = {};
  std::function<std::string(const std::string& surface, int triangle)> triangle_name = {};
};

// What was changed silently-harmless input into a valid mesh, one sentence each.
using Warnings = std::vector<std::string>;

// Makes sure that the mesh can be computed with: at least one element, indices in range,
// coordinates finite, no element that is inverted or degenerate (six volumes below 1e-14 of its
// longest edge cubed) and none that its curved edges fold over (det dX/dL below 1e-6 of that with straight edges at a
// node, or where stiffness or masses are integrated), no
// two elements that overlap at a common face or have different nodes on a common edge, no two nodes of elements at
// exactly the same place (a crack by mistake), no surface triangle that is not a face of an
// element. Nodes that no element uses (also from the node sets) and triangles that a surface lists
// twice are removed, with a warning; node sets are sorted. Surface triangles on the outer boundary are turned outward;
// those between two elements keep their side. Throws ConfigError naming the element and its origin.
Warnings validate(TetMesh& mesh, const MeshOrigin& origin);

}  // namespace orthodyn
