// Writes an unstructured grid with fields as a VTK XML file (.vtu): converted meshes, frames of a run, axes, mode
// shapes.
//
// Format: Kitware, VTK file formats, "XML file formats".
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "lib/core/cells.h"
#include "lib/core/types.h"

namespace orthodyn {

enum class VtuNumber { uint8, int32, float32, float64 };

// Values of all points or cells: values[components * k + component]. `type` is that of the numbers in the file.
struct VtuArray {
  std::string name;
  int components = 1;
  VtuNumber type = VtuNumber::float64;
  std::vector<double> values = {};
};

struct VtuGrid {
  std::span<const Vec3> points;  // m
  Cells cells;                   // indices of points
  std::vector<VtuArray> point_data = {}, cell_data = {};
  std::vector<std::string> region_names = {};  // field data "region_names", by number; may be empty
};

enum class VtuStorage {
  ascii,  // exact to the last digit and readable by every version
  raw,    // appended bytes in the byte order of this machine
};

// The file as consecutive parts, for write_file().
std::vector<std::string> vtu_text(const VtuGrid& grid, VtuStorage storage);

}  // namespace orthodyn
