// Axes of elements as a file has them: one row for each element it names.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "lib/config/values.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

struct AxesRows {
  struct Row {
    int element;  // from 0: of CSV as the mesh file counts them, of VTU a tetrahedron
    Mat3 columns;
    int place;  // line of a CSV file, solid cell of a VTU file
  };
  std::vector<Row> rows;
  bool third = false;  // whether axis 3 was given too; otherwise it is 1 x 2
  bool every = false;  // whether rows stand for elements 0, 1, 2, ... without saying so
  std::string path;
  std::optional<TetMesh> mesh;  // of the elements that they belong to, where the file has one

  std::string where(const Row& row) const { return fmt::format("{}{}{}", path, mesh ? ": cell " : ":", row.place); }
};

// Reads CSV with the columns a1x,a1y,a1z,a2x,a2y,a2z and, if wanted, element and a3x,a3y,a3z; or VTU with
// cell data of three components axis_1, axis_2 and optionally axis_3, or of nine axes: those of axis 1, then
// 2, then 3; or an Abaqus file whose sections have orientations. Vectors have any length but zero. Throws ConfigError
// (see read_csv(), read_vtu()).
AxesRows read_axes_rows(const FilePath& file);

}  // namespace orthodyn
