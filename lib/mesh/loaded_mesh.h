// What a mesh file says: the mesh, and what else it holds about its elements.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

// Engineering constants of a region as the file gives them, unchecked but for positive moduli and
// density.
struct MeshMaterial {
  enum class Kind { isotropic, orthotropic };

  std::string name;
  std::string where;  // "turtle.veg:1557"
  Kind kind = Kind::isotropic;
  double density = 0;           // kg/m^3
  Vec3 young = Vec3::Zero();    // E1, E2, E3, Pa; isotropic: all the same
  double nu12 = 0, nu23 = 0, nu31 = 0;  // nu_ij: contraction along j when stretched along i
  double g12 = 0, g23 = 0, g31 = 0;     // Pa
  Mat3 axes = Mat3::Identity();         // orthonormal, right-handed; columns are directions 1, 2, 3
};

// Values per element: values[components * element + component].
struct CellData {
  std::string name;
  int components = 1;
  std::vector<double> values = {};
};

struct LoadedMesh {
  TetMesh mesh = {};
  Warnings warnings = {};
  std::map<std::string, MeshMaterial> materials = {};  // by region; empty, or one for each region
  std::vector<CellData> cell_data = {};
};

// The array of this name, or null.
const CellData* find_cell_data(const LoadedMesh& loaded, const std::string& name);

}  // namespace orthodyn
