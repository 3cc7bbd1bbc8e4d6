// The faces of all tets of a mesh, sorted so that the two sides of an inner face are neighbours.
#pragma once

#include <vector>

#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

// One face as one tet sees it.
struct TetFace {
  Triangle nodes;  // ascending, so that both sides of an inner face have the same
  int tet;
  bool flipped;  // seen from outside the tet, `nodes` runs clockwise

  Triangle outward() const { return flipped ? Triangle{nodes[0], nodes[2], nodes[1]} : nodes; }
};

// Brings the three nodes into ascending order; true if that was an odd permutation.
bool sort_nodes(Triangle& nodes);

// Four faces per tet, sorted by nodes, then side, then tet. Node indices must be in range and
// volumes positive, else the sides mean nothing.
std::vector<TetFace> sorted_faces(const TetMesh& mesh);

// The faces with the same nodes as faces[begin] are [begin, end_of_face(faces, begin)).
std::size_t end_of_face(const std::vector<TetFace>& faces, std::size_t begin);

}  // namespace orthodyn
