// Loops over the faces of a surface, with the face type (linear or quadratic) of the mesh.
#pragma once

#include <span>
#include <vector>

#include "lib/element/tri3.h"
#include "lib/element/tri6.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {

template <Face F>
FaceNodes<F> face_positions(const TetMesh& mesh, std::span<const int> nodes) {
  FaceNodes<F> X;
  for (std::size_t a = 0; a < nodes.size(); ++a)
    X.col(static_cast<Eigen::Index>(a)) = mesh.nodes[static_cast<std::size_t>(nodes[a])];
  return X;
}

// Calls visit(nodes, X) for each face, with node indices and positions at rest. Precondition: the mesh has faces of
// type F.
template <Face F, class Visit>
void for_each_face_of(const TetMesh& mesh, const std::vector<Triangle>& triangles, const Visit& visit) {
  const Cells faces = face_cells(mesh, triangles);
  for (std::size_t k = 0; k < faces.size(); ++k) visit(faces[k], face_positions<F>(mesh, faces[k]));
}

// Likewise, calls visit.operator()<F>(nodes, X) with the face type F of the mesh.
template <class Visit>
void for_each_face(const TetMesh& mesh, const std::vector<Triangle>& triangles, const Visit& visit) {
  const auto all = [&]<Face F>() {
    for_each_face_of<F>(mesh, triangles, [&](std::span<const int> nodes, const FaceNodes<F>& X) {
      visit.template operator()<F>(nodes, X);
    });
  };
  if (mesh.order() == 1) all.template operator()<Tri3>();
  else all.template operator()<Tri6>();
}

}  // namespace orthodyn
