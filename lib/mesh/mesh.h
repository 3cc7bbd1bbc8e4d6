// A mesh of solid cells, all linear or all quadratic, with regions (named groups of cells), surfaces (named groups of
// faces, given by their corners) and named node sets. Lengths in m.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "lib/core/cells.h"
#include "lib/core/types.h"
#include "lib/mesh/face_corners.h"

namespace orthodyn {

using Tet = std::array<int, 4>;  // node indices; positive volume (v1-v0) . ((v2-v0) x (v3-v0)) > 0

// The corners of a tet's edges, in the order of its mid-edge nodes.
inline constexpr std::array<std::array<std::size_t, 2>, 6> kTetEdges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

struct Mesh {
  std::vector<Vec3> nodes;
  Cells cells;
  std::vector<int> region_of;             // for each cell an index into region_names
  std::vector<std::string> region_names;  // at least one
  std::map<std::string, std::vector<FaceCorners>> surfaces;
  std::map<std::string, std::vector<int>> node_sets;  // ascending, each node once
  // For each cell, the index (from 0, ascending) of the file's element that it is part of. Empty: no element was split.
  std::vector<int> cell_of = {};

  // 1: linear, 2: quadratic.
  int order() const { return cells.empty() ? 1 : topology(cells.shape(0)).order; }
  bool has_tets_only() const;

  const Vec3& node(int index) const { return nodes[static_cast<std::size_t>(index)]; }
};

struct Box {
  Vec3 min, max;
  Vec3 size() const { return max - min; }
  double diagonal() const { return size().norm(); }
};

Box bounding_box(const Mesh& mesh);

// Six times the signed volume of a tet, m^3.
double signed_volume6(const Mesh& mesh, const Tet& tet);

// The mean of the corners of a cell, m.
Vec3 centroid(const Mesh& mesh, int cell);

// Volume of a cell by its shape functions, m^3; negative for an inverted cell.
double cell_volume(const Mesh& mesh, std::size_t cell);

// Number of cells of each shape: "24 hexahedra of 20 nodes and 6 wedges of 15 nodes".
std::string describe_cells(const Cells& cells);

// The outer faces, oriented outward.
std::vector<FaceCorners> boundary_faces(const Mesh& mesh);

// Removes the marked nodes, also from node sets, and renumbers the others. Precondition: no element uses a marked node.
void remove_nodes(Mesh& mesh, const std::vector<char>& marked);

// Names of elements, nodes and faces for messages, such as "beam.msh:120: element 17". If a function is missing,
// the name is "<source>: element <index>". Indices are those before validate() removes anything.
struct MeshOrigin {
  std::string source;  // file or generator
  std::function<std::string(int cell)> cell_name = {};
  std::function<std::string(int node)> node_name = {};
  std::function<std::string(const std::string& surface, int face)> face_name = {};

  std::string cell(int index) const;
  std::string node(int index) const;
  std::string face(const std::string& surface, int index) const;
};

// Changes that were made to obtain a valid mesh, one sentence each.
using Warnings = std::vector<std::string>;

// Checks a mesh and cleans it up. Requires
//   at least one element, all of one order, indices in range, finite coordinates;
//   no inverted or degenerate element (|6 volume| < 1e-14 d^3, d the largest distance of two corners);
//   no folded element (at one of its checked_places(), det J <= 1e-6 of its value with straight edges, for hexahedra
//   and wedges of its mean);
//   no elements that overlap at a common face or have different nodes on a common edge or face;
//   no two nodes of elements at exactly the same position (an unintended crack);
//   no triangle of one element on a quadrilateral of another; no surface face that is not a face of an element.
// Removes, with a warning, nodes that no element uses and faces that a surface lists twice; sorts node sets; orients
// surface faces on the boundary outward (faces between two elements keep their orientation). Throws ConfigError with
// the name of the element, node or face.
Warnings validate(Mesh& mesh, const MeshOrigin& origin);

}  // namespace orthodyn
