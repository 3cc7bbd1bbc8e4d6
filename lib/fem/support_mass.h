// The part of the mass matrix that touches held nodes: M_ij where node i or node j is held, one number for
// the three coordinates. It gives the inertia of moved nodes and their pull on free ones.
#pragma once

#include <vector>

#include "lib/fem/mass.h"

namespace orthodyn {

class SupportMass {
 public:
  // density[cell] in kg/m^3; held nodes are those with a coordinate that is no unknown.
  SupportMass(const Mass& mass, const ElementMesh& mesh, const std::vector<double>& density, const DofMap& dofs);

  // M x (kg times the unit of x), complete at held nodes, and at all nodes for an x that is zero at free ones.
  NodalVector times(const NodalVector& x) const { return x * matrix_; }
  std::size_t bytes() const;

 private:
  SparseMatrix matrix_;  // symmetric, both triangles
};

// The coordinates that are no unknowns; zero for the others.
NodalVector held_part(const DofMap& dofs, const NodalVector& x);

}  // namespace orthodyn
