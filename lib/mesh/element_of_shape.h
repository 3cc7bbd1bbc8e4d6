// The element (lib/element) of a cell's shape.
#pragma once

#include "lib/element/hex20.h"
#include "lib/element/hex27.h"
#include "lib/element/hex8.h"
#include "lib/element/tet10.h"
#include "lib/element/tet4.h"
#include "lib/element/wedge15.h"
#include "lib/element/wedge18.h"
#include "lib/element/wedge6.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

// Calls visit.operator()<E>() with the element E of a solid cell's shape.
template <class Visit>
void with_element(CellShape shape, Visit&& visit) {
  switch (shape) {
    case CellShape::tet4: return visit.template operator()<Tet4>();
    case CellShape::tet10: return visit.template operator()<Tet10>();
    case CellShape::wedge6: return visit.template operator()<Wedge6>();
    case CellShape::wedge15: return visit.template operator()<Wedge15>();
    case CellShape::wedge18: return visit.template operator()<Wedge18>();
    case CellShape::hex8: return visit.template operator()<Hex8>();
    case CellShape::hex20: return visit.template operator()<Hex20>();
    case CellShape::hex27: return visit.template operator()<Hex27>();
    default: return;
  }
}

// Node positions of a cell, m. Precondition: E is its element.
template <class E>
ElementNodes<E::kNodes> positions(const Mesh& mesh, std::size_t cell) {
  ElementNodes<E::kNodes> X;
  for (Eigen::Index a = 0; a < X.cols(); ++a) X.col(a) = mesh.node(mesh.cells[cell][static_cast<std::size_t>(a)]);
  return X;
}

}  // namespace orthodyn
