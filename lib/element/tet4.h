// The linear tetrahedron: one strain per element, gradients of the shape functions.
#pragma once

#include "lib/core/types.h"

namespace orthodyn {

struct Tet4 {
  Mat3 B;         // rows: gradients of the shape functions of nodes 1, 2, 3, in material axes, 1/m
  double volume;  // m^3

  // `edges` has the columns X1-X0, X2-X0, X3-X0; Q the material axes as columns.
  static Tet4 from_edges(const Mat3& edges, const Mat3& Q) {
    return {edges.inverse() * Q, edges.determinant() / 6};
  }

  // F Q, resp. its rate, from the current edges, resp. their rates.
  Mat3 gradient(const Mat3& edges) const { return edges * B; }

  // Columns: the forces -dPsi/dx on nodes 1, 2, 3 (N); node 0 takes the negative sum. P is P Q.
  Mat3 node_forces(const Mat3& P) const { return -volume * P * B.transpose(); }
};

}  // namespace orthodyn
