// Reads and writes mesh files; the ending of the file name determines the format.
#pragma once

#include <string>

#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

// All names in the result are UTF-8. Throws ConfigError.
LoadedMesh read_mesh(const std::string& path, FileCells cells = FileCells::keep);

// Converts names of regions, sets, materials and cell data that are not UTF-8 from Latin-1, with a warning.
void make_names_utf8(LoadedMesh& loaded, const std::string& path);

// Writes a mesh. Formats of several files write them into the same folder. Returns what the format cannot represent.
// Throws ConfigError if a file exists and `replace` is false, if the format is read-only, or if a file cannot be
// written; existing files are then unchanged.
Warnings write_mesh(const LoadedMesh& loaded, const std::string& path, bool replace);

// Multiplies all coordinates. Throws ConfigError at `source` if the volume of an element over- or underflows.
void scale_mesh(Mesh& mesh, double factor, const std::string& source);

// The unit system of a mesh file. mm_t_s: mm, t, s; forces are then in N and stresses in MPa.
enum class FileUnits { si, mm_t_s };

// SI value of one unit of the file.
struct UnitFactors {
  double length = 1, stress = 1, density = 1;
};
constexpr UnitFactors factors_of(FileUnits units) {
  return units == FileUnits::si ? UnitFactors{} : UnitFactors{.length = 1e-3, .stress = 1e6, .density = 1e12};
}

// Converts coordinates and materials to SI. Throws ConfigError at `source` as scale_mesh() does.
void convert_to_si(LoadedMesh& loaded, FileUnits units, const std::string& source);

}  // namespace orthodyn
