// Loops over the faces of a surface, with the type of each face.
#pragma once

#include <span>
#include <vector>

#include "lib/element/quad4.h"
#include "lib/element/quad8.h"
#include "lib/element/quad9.h"
#include "lib/element/tri3.h"
#include "lib/element/tri6.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {

// Calls visit.operator()<F>(nodes, X) for each face, with its type F, node indices and positions at rest.
template <class Visit>
void for_each_face(const Mesh& mesh, const std::vector<FaceCorners>& corners, const Visit& visit) {
  const Cells faces = face_cells(mesh, corners);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const auto of_type = [&]<Face F>() {
      FaceNodes<F> X;
      for (Eigen::Index a = 0; a < X.cols(); ++a) X.col(a) = mesh.node(faces[k][static_cast<std::size_t>(a)]);
      visit.template operator()<F>(faces[k], X);
    };
    switch (faces.shape(k)) {
      case CellShape::tri3: of_type.template operator()<Tri3>(); break;
      case CellShape::tri6: of_type.template operator()<Tri6>(); break;
      case CellShape::quad4: of_type.template operator()<Quad4>(); break;
      case CellShape::quad8: of_type.template operator()<Quad8>(); break;
      case CellShape::quad9: of_type.template operator()<Quad9>(); break;
      default: break;
    }
  }
}

}  // namespace orthodyn
