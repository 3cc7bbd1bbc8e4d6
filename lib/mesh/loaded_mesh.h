// The content of a mesh file: the mesh, materials of regions, and values per element.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lib/mesh/mesh.h"

namespace orthodyn {

// Material constants of a region. The Vega reader checks that moduli and densities are positive; other readers do not
// check the constants.
struct MeshMaterial {
  enum class Kind { isotropic, orthotropic, anisotropic };

  std::string name;
  std::string where = {};  // "turtle.veg:1557"
  Kind kind = Kind::isotropic;
  double density = 0;                   // kg/m^3
  Vec3 young = Vec3::Zero();            // E1, E2, E3, Pa; isotropic: all equal
  double nu12 = 0, nu23 = 0, nu31 = 0;  // nu_ij: contraction along j when stretched along i
  double g12 = 0, g23 = 0, g31 = 0;     // Pa
  std::optional<double> nu13 = {};      // if the file gives it; nu31 follows from it
  // Anisotropic: C11, C12, C22, C13, C23, C33, C14, ... C66, Pa, with 4, 5, 6 = 12, 13, 23 (voigt_order: abaqus).
  std::array<double, 21> stiffness = {};
  Mat3 axes = Mat3::Identity();  // orthonormal, right-handed; columns are directions 1, 2, 3
  std::string axes_file = {};    // file with the material axes of each element; replaces `axes`

  std::string problem = {};  // why the constants could not be read, or ""
  // A keyword of nonlinear behaviour, which is not used: its place in the file, and its name.
  struct Beyond {
    std::string where, name;
  };
  std::vector<Beyond> beyond = {};
  std::vector<std::string> without_effect = {};  // keywords that do not affect the motion
};

// A ply of a layered region.
struct MeshPly {
  MeshMaterial material;
  double degrees = 0;    // from axis 1 of the region to axis 1 of the material, about axis 3
  double thickness = 0;  // m
};

struct MeshLayup {
  std::vector<MeshPly> plies;  // from bottom to top along axis 3
  std::string axes_file = {};  // file with the axes of each element; "" for the space axes
};

// Values per element: values[components * element + component].
struct CellData {
  std::string name;
  int components = 1;
  std::vector<double> values = {};
};

// Treatment of the hexahedra and wedges of a file. If the file has pyramids, or elements that collapse to fewer
// corners, all its elements are split, so that faces match.
enum class FileCells {
  keep,
  split,  // into tetrahedra
};

struct LoadedMesh {
  Mesh mesh = {};
  Warnings warnings = {};
  std::map<std::string, MeshMaterial> materials = {};  // by region; may be missing for some
  std::map<std::string, MeshLayup> layups = {};        // of layered regions, by region
  std::vector<CellData> cell_data = {};
};

// Calls visit(region, material) for the materials of all regions and plies.
template <class Loaded, class Visit>
void for_each_material(Loaded& loaded, Visit&& visit) {
  for (auto& [region, material] : loaded.materials) visit(region, material);
  for (auto& [region, layup] : loaded.layups)
    for (auto& ply : layup.plies) visit(region, ply.material);
}

// The cell data of this name, or null.
inline const CellData* find_cell_data(const LoadedMesh& loaded, const std::string& name) {
  for (const CellData& data : loaded.cell_data)
    if (data.name == name) return &data;
  return nullptr;
}

}  // namespace orthodyn
