// Turns what a Gmsh file says into a valid mesh.
#pragma once

#include "lib/mesh/io/gmsh.h"
#include "lib/mesh/io/gmsh_file.h"
#include "lib/mesh/io/text_tokens.h"

namespace orthodyn {

// Takes the nodes out of the file. The tokens name the file in messages. Throws ConfigError for
// tags that are not defined or defined twice, for sections or tets that are missing, and for what
// validate() refuses.
LoadedMesh build_gmsh_mesh(GmshFile& file, const TextTokens& tokens);

}  // namespace orthodyn
