// Uniform refinement: each tetrahedron in eight, with half as long edges (Bey 1995, Computing 55, 355; the inner
// octahedron along its shortest diagonal).
#pragma once

#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

// Regions, surfaces, node sets and values of cells stay; the children of cell k are 8 k to 8 k + 7. Curved edges are
// those of the cells before. Precondition: a valid mesh.
void refine(LoadedMesh& loaded);

}  // namespace orthodyn
