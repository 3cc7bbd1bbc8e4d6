// The elastic parts of a scene's body: its regions, the plies of layered regions, the elements of each kind in regions
// of several kinds, and the elements in each cell of a grid of stiffness factors.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/fem/terms/added_term.h"
#include "lib/material_axes/axes_source.h"
#include "lib/scene/scene.h"

namespace orthodyn {

struct ElasticPart {
  std::string
      name;  // "REGION", "REGION.hexahedra", "REGION.ply_2", "REGION.ply_2_1" for a part of a ply, "REGION.cell_4"
  std::size_t region;   // index in the mesh
  const Region* entry;  // the region's section in the scene
  const Material* material;
  AxesField axes;
  const ElementType* type;
  std::vector<int> cells;       // ascending
  double share = 1;             // thickness of the ply relative to its cells; 1 for a region
  double density;               // kg/m^3, the mean over the thickness of its cells
  std::string ply = {};         // "REGION.ply_2" for all parts of this ply; "" for other parts
  int stiffness_cell = -1;      // cell of the grid of stiffness factors; -1 for regions without
  double stiffness_factor = 1;  // of this cell
};

struct ElasticParts {
  std::vector<ElasticPart> parts;
  std::vector<std::unique_ptr<const ElementType>> ply_types;  // used by `parts`
  std::vector<double> density;                                // of each cell, kg/m^3; 0 where the inertia is given
};

// The parts of all regions that have cells. `regions`: result of assign_regions(). Renumbers the nodes of cells in
// layered regions. Throws ConfigError for a layered region with cells of several shapes, for `integration` without
// hexahedra of 20 nodes, and like make_stack(). Scene and regions must outlive the result.
ElasticParts elastic_parts(const Scene& scene, const std::vector<const Region*>& regions, Mesh& mesh, Warnings& notes);

// The box that the grid of stiffness factors of the scene's region `name` fills: the bounding box of all cells of the
// mesh that this entry describes.
Box grid_box(const Scene& scene, const std::string& name, const Mesh& mesh);

// Adds the elastic terms to `parts`, and returns the terms of the added laws. `own`: the elements of this rank. Axes
// and fields are evaluated on the whole mesh.
std::vector<std::unique_ptr<AddedTerm>> add_elasticity(const Scene& scene, ElasticParts elastic, const ElementMesh& own,
                                                       FemModel::Parts& parts);

// Stiffness-proportional damping (s) of the region, else of the scene, else 0.
double stiffness_damping(const Scene& scene, const Region& region);

}  // namespace orthodyn
