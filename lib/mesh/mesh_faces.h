// The faces of all cells of a mesh, sorted so that both sides of an inner face are adjacent.
#pragma once

#include <vector>

#include "lib/mesh/mesh.h"

namespace orthodyn {

// A face of a cell.
struct MeshFace {
  FaceCorners corners;  // sorted: the same for both sides of an inner face
  int cell;
  bool flipped;  // `corners` is clockwise as seen from outside the cell

  FaceCorners outward() const { return flipped ? corners.reversed() : corners; }
};

// All faces, sorted by corners, then by `flipped`, then by cell. Precondition: node indices in range, positive volumes.
std::vector<MeshFace> sorted_faces(const Mesh& mesh);

// The faces with the same corners as faces[begin] are [begin, end_of_face(faces, begin)).
std::size_t end_of_face(const std::vector<MeshFace>& faces, std::size_t begin);

// Indices of the first face with these corners (given in any order) and of the end of these faces; equal if there are
// none. `faces`: sorted_faces().
std::pair<std::size_t, std::size_t> find_faces(const std::vector<MeshFace>& faces, FaceCorners corners);

}  // namespace orthodyn
