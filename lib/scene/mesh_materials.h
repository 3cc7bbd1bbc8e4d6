// Materials that the mesh file brings, as if they were typed in the scene.
#pragma once

#include "lib/scene/scene.h"

namespace orthodyn {

// For a scene without `materials`: takes them from the mesh into `config` and `scene`, and likewise
// the material and axes of each region if the scene has no `regions`. They pass the same checks as
// typed ones. Loads the mesh. Throws ConfigError if the mesh says nothing of materials, or nothing
// of those of some of its regions.
void fill_mesh_materials(const Config& config, Scene& scene);

// The constants as the scene's input says them, on one line: "{type: isotropic, ...}". Precondition: no problem.
std::string material_yaml(const MeshMaterial& material);

// The scene's mesh, which is read here if it was not for its materials. Throws ConfigError.
LoadedMesh load_mesh(const Scene& scene);

}  // namespace orthodyn
