// The line below *MATERIAL of a .veg file.
#pragma once

#include <string>

#include "lib/mesh/loaded_mesh.h"
#include "lib/mesh/io/text_tokens.h"

namespace orthodyn {

// "ENU, density, E, nu" or "ORTHOTROPIC..., density, E1, E2, E3, ...". Leaves the cursor behind the
// line. Throws ConfigError for other kinds, for a wrong count of numbers, and for axes that are not
// orthonormal by more than rounding; warns where these were repaired.
MeshMaterial read_vega_material(TextTokens& tokens, const std::string& name, Warnings& warnings);

}  // namespace orthodyn
