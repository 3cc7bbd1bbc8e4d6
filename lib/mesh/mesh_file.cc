#include "lib/mesh/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "lib/core/errors.h"
#include "lib/mesh/abaqus.h"
#include "lib/mesh/gmsh.h"
#include "lib/mesh/tetgen.h"
#include "lib/mesh/vega.h"
#include "lib/mesh/vtk.h"
#include "lib/mesh/vtu.h"

namespace orthodyn {
namespace {

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

}  // namespace

const std::vector<MeshFormat>& mesh_formats() {
  static const std::vector<MeshFormat> formats{
      {"Gmsh", {".msh"}, [](const std::string& path) { return read_gmsh(path); }, false},
      {"TetGen", {".node", ".ele"}, read_tetgen, false},
      {"Abaqus", {".inp"}, read_abaqus, false},
      {"VTK XML", {".vtu"}, read_vtu, false},
      {"VTK legacy", {".vtk"}, read_vtk, false},
      {"Vega", {".veg"}, [](const std::string& path) { return read_vega(path); }, true},
  };
  return formats;
}

const MeshFormat& mesh_format_of(const std::string& path) {
  const std::string ending = ending_of(path);
  std::string known;
  for (const MeshFormat& format : mesh_formats()) {
    for (const std::string& e : format.endings) {
      if (e == ending) return format;
      known += fmt::format("{}{} ({})", known.empty() ? "" : ", ", e, format.name);
    }
  }
  throw ConfigError(fmt::format("{}: no mesh format has the ending \"{}\"; known: {}", path, ending, known));
}

LoadedMesh read_mesh(const std::string& path) { return mesh_format_of(path).read(path); }

void scale_mesh(TetMesh& mesh, double factor, const std::string& source) {
  for (Vec3& x : mesh.nodes) x *= factor;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (std::isnormal(signed_volume6(mesh, mesh.tets[e]) / 6)) continue;
    throw ConfigError(fmt::format("{}: scaled by {}, the volume of element {} cannot be represented; check the scale",
                                  source, factor, e));
  }
}

}  // namespace orthodyn
