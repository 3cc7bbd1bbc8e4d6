// Hexahedra, wedges and pyramids cut into tetrahedra that match across common faces: each quadrilateral face is cut by
// the diagonal through its smallest node number, which both elements beside it see alike.
//
// Source: J. Dompierre, P. Labbe, M.-G. Vallet, R. Camarero, "How to subdivide pyramids, prisms, and hexahedra into
// tetrahedra", 8th International Meshing Roundtable, 1999.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lib/mesh/cell_kind.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

using Places = std::vector<std::size_t>;  // of corners in an element

// The faces of an element, clockwise from outside, as Abaqus lists S1, S2, ...: Abaqus elements guide,
// "three-dimensional solid element library".
const std::vector<Places>& faces_of(CellKind kind);

// The corners of the edges, as Abaqus and VTK list the nodes in their middles; empty of a tet, whose edges are
// kTetEdges.
const std::vector<std::array<std::size_t, 2>>& edges_of(CellKind kind);

// Appends the triangles of a face of three or four nodes. Nodes may be repeated: what has no area is left out.
void append_triangles(std::span<const int> face, std::vector<Triangle>& triangles);

// Appends the tetrahedra of an element: a tet itself, two of a pyramid, three of a wedge, five or six of a hexahedron,
// each with positive volume if the element has plane faces and is not inverted. Corners may be repeated along edges
// (a hexahedron that stands for a wedge): tets without volume are left out. False if they are repeated otherwise, or
// if no tet is left.
bool append_tets(CellKind kind, std::span<const int> corners, std::vector<Tet>& tets);

}  // namespace orthodyn
