// The elastic parts of a scene's body: its regions, or the plies of layered regions.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/material_axes/axes_source.h"
#include "lib/scene/scene.h"

namespace orthodyn {

struct ElasticPart {
  std::string name;     // of the region, or "REGION.ply_2"
  std::size_t region;   // in the mesh
  const Region* entry;  // of the scene
  const Material* material;
  AxesField axes;
  const ElementType* type;
  std::vector<int> cells;  // ascending
  double share = 1;        // of a ply in the thickness of its cells
  double density;          // kg/m^3, the mean over the thickness of its cells
  std::string ply = {};    // "REGION.ply_2" also for a part of this ply; "" for a region
};

struct ElasticParts {
  std::vector<ElasticPart> parts;
  std::vector<std::unique_ptr<const ElementType>> ply_types;  // parts refer to them
  std::vector<double> density;                                // of each cell, kg/m^3
};

// The parts of all regions that have cells. `regions`: the entries of the mesh's regions (assign_regions()). Renumbers
// the nodes of cells in layered regions (make_stack()). Throws ConfigError for a region with cells of several shapes,
// and for a layup that the cells cannot have. Scene and regions must outlive the result.
ElasticParts elastic_parts(const Scene& scene, const std::vector<const Region*>& regions, Mesh& mesh, Warnings& notes);

// Makes the elastic terms. `own`: the elements of this rank. Axes are evaluated on the whole mesh.
void add_elasticity(const Scene& scene, ElasticParts elastic, const ElementMesh& own, FemModel::Parts& parts);

// s, of the region or of the scene.
double stiffness_damping(const Scene& scene, const Region& region);

}  // namespace orthodyn
