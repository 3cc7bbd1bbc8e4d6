// A region of a mesh with its elasticity, as ElementType::elastic_term takes it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/fem/element_axes.h"
#include "lib/fem/terms/elasticity_options.h"
#include "lib/material/stiffness.h"
#include "lib/material/strength.h"

namespace orthodyn {

struct ElasticRegion {
  std::string name;
  std::vector<int> cells;  // of the mesh; may be none of a rank's part
  Stiffness stiffness;     // Pa, in material axes
  ElementAxes axes;        // of these cells
  double beta = 0;         // s, stiffness-proportional damping; 0 for none
  ElasticityOptions options;
  std::optional<Strength> strength = {};  // where the material tells it
  std::vector<int> numbers = {};          // of the cells in the whole mesh, where theirs is the part of a rank
  int elements = 0;                       // then: of all ranks
};

}  // namespace orthodyn
