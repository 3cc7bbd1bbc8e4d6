// The section `regions`: material and axes of the mesh's regions, with one entry for each region or one for `all`.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/config/spec.h"
#include "lib/fem/terms/elasticity_options.h"
#include "lib/material/material.h"
#include "lib/mesh/mesh.h"
#include "lib/scene/layup.h"
#include "lib/scene/rigid_input.h"
#include "lib/scene/stiffness_factors.h"

namespace orthodyn {

class AxesSource;
struct Scene;

// automatic: full for hexahedra in rows that are one cell wide and high (lib/mesh/cell_rows.h), otherwise reduced.
enum class Integration { automatic, reduced, full };

// automatic: mixed for nearly incompressible materials, if the elements have a mixed formulation.
enum class Formulation { automatic, displacement, mixed };

// Elastic law: the corotational one (elasticity.kinematics chooses its variant), or neo-Hookean.
enum class ElasticLaw { corotational, neo_hookean };

struct Region {
  std::string material;    // empty if there is a layup
  std::vector<Ply> layup;  // from bottom to top; empty for a region of one material
  std::shared_ptr<const AxesSource> axes;
  std::optional<double> stiffness_damping;  // s; overrides damping.stiffness
  std::optional<Kinematics> kinematics;     // overrides elasticity.kinematics
  std::optional<StiffnessFactors> stiffness_factors;
  ElasticLaw law = ElasticLaw::corotational;
  RigidInput rigid;
  Integration integration = Integration::automatic;
  Formulation formulation = Formulation::automatic;
  SourceLocation origin;

  std::vector<std::string> materials() const;  // of the region or of its plies
  static const Spec<Region>& spec();
};

// Completes a scene without `regions`, whose only material fills the mesh. Throws ConfigError if such a scene has
// several materials, if a region's material does not exist, or if kinematics and other options of elasticity conflict.
void complete_regions(const Config& config, Scene& scene);

// For each region of the mesh, the entry of scene.regions that describes the region. Throws ConfigError for mesh
// regions without an entry and entries without a mesh region.
std::vector<const Region*> assign_regions(const Scene& scene, const Mesh& mesh);

// Precondition: the scene has the material.
const Material& material_named(const Scene& scene, const std::string& name);

// The scene's options of elasticity, with the region's kinematics if given.
ElasticityOptions elasticity_of(const Scene& scene, const Region& region);

// The entry that describes a region of the mesh.
const std::pair<std::string, Region>& entry_of(const Scene& scene, const std::string& mesh_region);

}  // namespace orthodyn
