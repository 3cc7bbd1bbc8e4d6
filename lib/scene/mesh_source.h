// Where a scene's mesh comes from: one kind per entry of Registry<MeshSource>.
#pragma once

#include "lib/core/registry.h"
#include "lib/mesh/gmsh.h"

namespace orthodyn {

class MeshSource {
 public:
  virtual ~MeshSource() = default;
  virtual LoadedMesh load() const = 0;  // throws ConfigError
};

}  // namespace orthodyn
