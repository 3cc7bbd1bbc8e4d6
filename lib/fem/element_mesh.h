// A mesh of cells with their element types.
#pragma once

#include <vector>

#include "lib/core/cells.h"
#include "lib/fem/element_type.h"
#include "lib/fem/ties/ties.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

struct ElementMesh {
  const std::vector<Vec3>& nodes;  // positions at rest, m
  const Cells& cells;
  const Ties* ties;  // null: no node is tied

  // All arguments must outlive this object.
  ElementMesh(const std::vector<Vec3>& positions_at_rest, const Cells& its_cells)
      : nodes(positions_at_rest), cells(its_cells), ties(nullptr) {}
  explicit ElementMesh(const Mesh& mesh, const Ties* its_ties = nullptr)
      : nodes(mesh.nodes), cells(mesh.cells), ties(its_ties) {}
  ElementMesh(Mesh&&) = delete;

  const ElementType& type(std::size_t cell) const { return element_type(cells.shape(cell)); }

  // Node positions of one cell, one column each.
  ElementType::Nodes positions(std::size_t cell) const {
    ElementType::Nodes X(3, static_cast<Eigen::Index>(cells[cell].size()));
    for (Eigen::Index a = 0; a < X.cols(); ++a)
      X.col(a) = nodes[static_cast<std::size_t>(cells[cell][static_cast<std::size_t>(a)])];
    return X;
  }
};

}  // namespace orthodyn
