// Uniform refinement: splits each cell into eight with edges half as long. Tetrahedra: Bey 1995, Computing 55, 355; the
// inner octahedron is split along its shortest diagonal. Hexahedra and wedges are halved along each natural coordinate.
#pragma once

#include <vector>

#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

// Keeps regions, surfaces, node sets and cell data. The children of cell k are 8 k to 8 k + 7. Curved edges keep the
// shape of the coarse cells. Precondition: a valid mesh.
void refine(LoadedMesh& loaded);

// Natural coordinates (lib/element) in a hexahedron or wedge of the corners of its eight children.
const std::vector<std::vector<Vec3>>& corners_of_children(CellShape parent);

}  // namespace orthodyn
