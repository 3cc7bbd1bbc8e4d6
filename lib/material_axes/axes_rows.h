// Reads material axes of elements from a file, one row per element.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "lib/config/values.h"
#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

struct AxesRows {
  struct Row {
    int element;  // from 0: element of the mesh file (CSV), or tetrahedron (VTU)
    Mat3 columns;
    int place;  // line (CSV) or solid cell (VTU), for messages
  };
  std::vector<Row> rows;
  bool has_third = false;        // axis 3 is given; otherwise it is 1 x 2
  bool one_per_element = false;  // rows have no element numbers; row k belongs to element k
  std::string path;
  std::optional<Mesh> mesh;  // mesh of the file, if it has one

  std::string where(const Row& row) const { return fmt::format("{}{}{}", path, mesh ? ": cell " : ":", row.place); }
};

// Reads CSV with the columns a1x,a1y,a1z,a2x,a2y,a2z and optionally element and a3x,a3y,a3z; VTU with the cell data
// axis_1, axis_2 and optionally axis_3 (3 components each), or axes (9: axis 1, axis 2, axis 3); or an Abaqus file
// whose sections have orientations. Vectors may have any nonzero length. Throws ConfigError (see read_csv(),
// read_vtu()).
AxesRows read_axes_rows(const FilePath& file, FileCells cells);

}  // namespace orthodyn
