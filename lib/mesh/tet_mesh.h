// A mesh of linear tetrahedra with regions (named groups of cells), surfaces (named groups of
// boundary triangles) and named sets of nodes. Lengths in metres.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "lib/core/types.h"

namespace orthodyn {

using Tet = std::array<int, 4>;  // node indices; positive volume (v1-v0) . ((v2-v0) x (v3-v0)) > 0
using Triangle = std::array<int, 3>;  // node indices

struct TetMesh {
  std::vector<Vec3> nodes;
  std::vector<Tet> tets;
  std::vector<int> region_of;             // for each tet an index into region_names
  std::vector<std::string> region_names;  // at least one
  std::map<std::string, std::vector<Triangle>> surfaces;
  std::map<std::string, std::vector<int>> node_sets;  // ascending, each node once
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
// longest edge cubed), no two elements that overlap at a common face, no two nodes of elements at
// exactly the same place (a crack by mistake), no surface triangle that is not a face of an
// element. Nodes that no element uses (also from the node sets) and triangles that a surface lists
// twice are removed, with a warning; node sets are sorted. Surface triangles on the outer boundary are turned outward;
// those between two elements keep their side. Throws ConfigError naming the element and its origin.
Warnings validate(TetMesh& mesh, const MeshOrigin& origin);

}  // namespace orthodyn
