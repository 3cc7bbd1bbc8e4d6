// Materials of the mesh file as materials of the scene.
#pragma once

#include "lib/scene/scene.h"

namespace orthodyn {

// Adds the materials of the mesh file to `config` and `scene`, for a scene without `materials`. If the scene has no
// `regions` either, adds the material and axes of each region. All additions are checked like those of a scene. Loads
// the mesh. Throws ConfigError if the mesh file lacks the material of a region, or a material has properties that are
// not supported.
void fill_mesh_materials(const Config& config, Scene& scene);

// A material as scene input on one line: "{type: isotropic, ...}". Precondition: m.problem is empty.
std::string material_yaml(const MeshMaterial& material);

// The key `layup` of a region.
std::string layup_yaml(const MeshLayup& layup);

// The scene's mesh. It is read from the file unless it was already read for its materials. Throws ConfigError.
LoadedMesh load_mesh(const Scene& scene);

}  // namespace orthodyn
