// Uniform refinement: splits each tetrahedron into eight with edges half as long (Bey 1995, Computing 55, 355; the
// inner octahedron is split along its shortest diagonal).
#pragma once

#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

// Keeps regions, surfaces, node sets and cell data. The children of cell k are 8 k to 8 k + 7. Curved edges keep the
// shape of the coarse cells. Precondition: a valid mesh.
void refine(LoadedMesh& loaded);

}  // namespace orthodyn
