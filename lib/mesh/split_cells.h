// Splits hexahedra, wedges and pyramids into tetrahedra that match across common faces: each quadrilateral face is cut
// by the diagonal through its smallest node number, which is the same for both elements.
//
// Source: J. Dompierre, P. Labbe, M.-G. Vallet, R. Camarero, "How to subdivide pyramids, prisms, and hexahedra into
// tetrahedra", 8th International Meshing Roundtable, 1999.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lib/mesh/cell_kind.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

using CornerIndices = std::vector<std::size_t>;  // local indices of corners in an element

// Corners of the faces, clockwise as seen from outside, in the order S1, S2, ... of Abaqus (elements guide,
// "three-dimensional solid element library").
const std::vector<CornerIndices>& faces_of(CellKind kind);

// Corners of the edges, in the order in which Abaqus and VTK list mid-edge nodes; empty for a tet (see kTetEdges).
const std::vector<std::array<std::size_t, 2>>& edges_of(CellKind kind);

// Appends the triangles of a face of three or four nodes. Triangles with repeated nodes are left out.
void append_triangles(std::span<const int> face, std::vector<FaceCorners>& triangles);

// Appends the tetrahedra of an element: one for a tet, two for a pyramid, three for a wedge, five or six for a
// hexahedron. Their volumes are positive if the element has plane faces and is not inverted. Corners may be repeated
// along edges (a hexahedron collapsed to a wedge): tets without volume are left out. Returns false if corners are
// repeated otherwise, or if no tet is left.
bool append_tets(CellKind kind, std::span<const int> corners, std::vector<Tet>& tets);

}  // namespace orthodyn
