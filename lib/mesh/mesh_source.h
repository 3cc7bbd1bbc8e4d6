// Source of a scene's mesh, chosen by `mesh: {type: ...}` from Registry<MeshSource>.
#pragma once

#include "lib/config/registry.h"
#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

class MeshSource {
 public:
  virtual ~MeshSource() = default;
  virtual LoadedMesh load() const = 0;  // throws ConfigError

  // False if load() never returns materials.
  virtual bool may_bring_materials() const { return false; }
};

}  // namespace orthodyn
