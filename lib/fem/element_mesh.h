// A mesh of elements of one type.
#pragma once

#include <utility>
#include <vector>

#include "lib/core/cells.h"
#include "lib/fem/element_type.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {

struct ElementMesh {
  const ElementType& type;
  const std::vector<Vec3>& nodes;  // positions at rest, m
  Cells cells;                     // nodes in the order of the element type

  // `its_type` and `positions_at_rest` must outlive this object. Precondition: the cells have as many nodes as the
  // type.
  ElementMesh(const ElementType& its_type, const std::vector<Vec3>& positions_at_rest, Cells its_cells)
      : type(its_type), nodes(positions_at_rest), cells(std::move(its_cells)) {}

  // The tetrahedra of a mesh, which must outlive this object.
  explicit ElementMesh(const TetMesh& mesh)
      : ElementMesh(mesh.order() == 1 ? linear_tetrahedron() : quadratic_tetrahedron(), mesh.nodes, tet_cells(mesh)) {}

  // Node positions of one cell, one column each.
  ElementType::Nodes positions(std::size_t cell) const {
    ElementType::Nodes X(3, cells.nodes_per_cell());
    for (Eigen::Index a = 0; a < X.cols(); ++a)
      X.col(a) = nodes[static_cast<std::size_t>(cells[cell][static_cast<std::size_t>(a)])];
    return X;
  }
};

}  // namespace orthodyn
