// The faces of all tets of a mesh, sorted so that both sides of an inner face are adjacent.
#pragma once

#include <vector>

#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

// A face of a tet.
struct TetFace {
  Triangle nodes;  // ascending; the same for both sides of an inner face
  int tet;
  bool flipped;  // `nodes` is clockwise as seen from outside the tet

  Triangle outward() const { return flipped ? Triangle{nodes[0], nodes[2], nodes[1]} : nodes; }
};

// Sorts the nodes; returns true for an odd permutation.
bool sort_nodes(Triangle& nodes);

// Four faces per tet, sorted by nodes, then side, then tet. Precondition: node indices in range, positive volumes.
std::vector<TetFace> sorted_faces(const TetMesh& mesh);

// The faces with the same nodes as faces[begin] are [begin, end_of_face(faces, begin)).
std::size_t end_of_face(const std::vector<TetFace>& faces, std::size_t begin);

}  // namespace orthodyn
