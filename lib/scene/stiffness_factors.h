// Factors of a region's stiffness that vary in space: one factor for each cell of a regular grid over the bounding box
// of the region. An element has the factor of the grid's cell in which its centroid lies.
//
// The factor multiplies the elastic tensor, and with it the stiffness-proportional damping. The density stays.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lib/config/spec.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

struct StiffnessFactors {
  std::array<int, 3> grid{1, 1, 1};           // number of cells along x, y and z
  std::optional<std::vector<double>> values;  // one for each cell, first along x, then y, then z; default 1
  std::optional<FilePath> file;               // instead of `values`
  SourceLocation origin;
  static const Spec<StiffnessFactors>& spec();

  // A factor for each cell. Throws ConfigError if the file cannot be read or lacks a cell.
  std::vector<double> all() const;

  // Number of the cell at a point of the box; the nearest one for a point outside.
  int cell_at(const Vec3& point, const Box& box) const;
  // Position of the middle of a cell.
  Vec3 centre(int cell, const Box& box) const;
  // The neighbours of a cell along +x, +y and +z.
  std::vector<int> neighbours(int cell) const;
};

}  // namespace orthodyn
