// Surfaces of an Abaqus mesh: those of *SURFACE, the faces loaded by *DLOAD, and element sets of shell and plane
// elements.
#pragma once

#include "lib/mesh/io/abaqus_lookup.h"

namespace orthodyn {

// Adds the surfaces to the draft. Throws ConfigError for a face that its element does not have and for a *SURFACE
// without elements.
void add_abaqus_surfaces(AbaqusFile& file, AbaqusLookup& lookup);

}  // namespace orthodyn
