// The material and axes of the mesh's regions, the section `regions`: an entry for each, or one for `all`.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/config/spec.h"
#include "lib/fem/terms/elasticity_options.h"
#include "lib/material/material.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

class AxesSource;
struct Scene;

struct Region {
  std::string material;
  std::shared_ptr<const AxesSource> axes;
  std::optional<double> stiffness_damping;  // s; overrides damping.stiffness
  std::optional<Kinematics> kinematics;     // overrides elasticity.kinematics
  SourceLocation origin;
  static const Spec<Region>& spec();
};

// Completes a scene without regions: its only material is everywhere. Throws ConfigError if there are several, or for a
// material that the scene does not have.
void complete_regions(const Config& config, Scene& scene);

// For each region of the mesh the entry of scene.regions that describes it. Throws ConfigError for regions without an
// entry, and for entries without a region.
std::vector<const Region*> assign_regions(const Scene& scene, const TetMesh& mesh);

const Material& material_of(const Scene& scene, const Region& region);

// The scene's, with the region's own kinematics.
ElasticityOptions elasticity_of(const Scene& scene, const Region& region);

// The entry that describes a region of the mesh.
const std::pair<std::string, Region>& entry_of(const Scene& scene, const std::string& mesh_region);

// The material of a region of the mesh.
const Material& material_in(const Scene& scene, const std::string& mesh_region);

}  // namespace orthodyn
