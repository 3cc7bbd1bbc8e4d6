// What the numbers of a mesh file stand for.
#pragma once

#include <string>

#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

enum class FileUnits { si, mm_t_s };

// In SI units: what one of the file is. With mm, t and s forces are in N, and stresses in MPa.
struct UnitFactors {
  double length = 1, stress = 1, density = 1;
};
constexpr UnitFactors factors_of(FileUnits units) {
  return units == FileUnits::si ? UnitFactors{} : UnitFactors{.length = 1e-3, .stress = 1e6, .density = 1e12};
}

// Coordinates and materials to SI. Throws ConfigError as scale_mesh() does; `source` is for messages.
void convert_to_si(LoadedMesh& loaded, FileUnits units, const std::string& source);

}  // namespace orthodyn
