// The tetrahedra of a mesh, for tests that count or change them.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "lib/mesh/mesh.h"

namespace orthodyn {

// The corners of each cell. Throws std::logic_error if a cell is no tetrahedron.
inline std::vector<Tet> tets_of(const Mesh& mesh) {
  if (!mesh.has_tets_only()) throw std::logic_error("a cell is no tetrahedron");
  std::vector<Tet> tets(mesh.cells.size());
  for (std::size_t e = 0; e < tets.size(); ++e) std::ranges::copy(mesh.cells.corners(e), tets[e].begin());
  return tets;
}

}  // namespace orthodyn
