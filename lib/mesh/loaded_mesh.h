// What a mesh file says: the mesh, and what else it holds about its elements.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

// Material constants of a region as read from the file. The Vega reader checks that moduli and densities are positive;
// other readers check nothing.
struct MeshMaterial {
  enum class Kind { isotropic, orthotropic, anisotropic };

  std::string name;
  std::string where = {};  // "turtle.veg:1557"
  Kind kind = Kind::isotropic;
  double density = 0;                   // kg/m^3
  Vec3 young = Vec3::Zero();            // E1, E2, E3, Pa; isotropic: all the same
  double nu12 = 0, nu23 = 0, nu31 = 0;  // nu_ij: contraction along j when stretched along i
  double g12 = 0, g23 = 0, g31 = 0;     // Pa
  std::optional<double> nu13 = {};      // where the file has it, and nu31 follows
  // Anisotropic: C11, C12, C22, C13, C23, C33, C14, ... C66, Pa, with 4, 5, 6 = 12, 13, 23 (voigt_order: abaqus).
  std::array<double, 21> stiffness = {};
  Mat3 axes = Mat3::Identity();  // orthonormal, right-handed; columns are directions 1, 2, 3
  std::string axes_file = {};    // file with the material axes of each element; replaces `axes`

  std::string problem = {};  // why the constants could not be read, or ""
  // A keyword that goes beyond linear elasticity: its place in the file, and its name.
  struct Beyond {
    std::string where, name;
  };
  std::vector<Beyond> beyond = {};
  std::vector<std::string> without_effect = {};  // keywords that do not affect the motion
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
  std::map<std::string, MeshMaterial> materials = {};  // by region; not of all, if the file does not say
  std::vector<CellData> cell_data = {};
};

// The array of this name, or null.
const CellData* find_cell_data(const LoadedMesh& loaded, const std::string& name);

}  // namespace orthodyn
