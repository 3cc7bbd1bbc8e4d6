#include "lib/mesh/io/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <system_error>

#include "lib/core/errors.h"
#include "lib/core/write_file.h"
#include "lib/mesh/io/abaqus.h"
#include "lib/mesh/io/gmsh.h"
#include "lib/mesh/io/tetgen.h"
#include "lib/mesh/io/vega.h"
#include "lib/mesh/io/vtk.h"
#include "lib/mesh/io/vtu.h"

namespace orthodyn {
namespace {

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

// Files of one mesh belong together: none takes its place before all are on the disk.
void replace_together(const std::vector<MeshText>& files, const std::function<std::string(const MeshText&)>& place) {
  namespace fs = std::filesystem;
  const auto beside = [&](const MeshText& file) { return place(file) + ".new"; };
  for (const MeshText& file : files) {
    std::string reason;
    try {
      write_file(beside(file), {file.text});
      continue;
    } catch (const RunError&) {
      reason = std::strerror(errno);
    }
    std::error_code ignored;
    for (const MeshText& f : files) fs::remove(beside(f), ignored);
    throw ConfigError(fmt::format("{}: cannot be written: {}", place(file), reason));
  }
  for (const MeshText& file : files) {
    std::error_code error;
    fs::rename(beside(file), place(file), error);
    if (error) throw ConfigError(fmt::format("{}: cannot be written: {}; the mesh is in {}", place(file), error.message(), beside(file)));
  }
}

}  // namespace

const std::vector<MeshFormat>& mesh_formats() {
  static const std::vector<MeshFormat> formats{
      {"Gmsh", {".msh"}, [](const std::string& path) { return read_gmsh(path); }, false, write_gmsh41},
      {"Gmsh 2.2", {".msh2"}, [](const std::string& path) { return read_gmsh(path); }, false, write_gmsh22},
      {"TetGen", {".node", ".ele"}, read_tetgen, false, write_tetgen},
      {"Abaqus", {".inp"}, read_abaqus, false, write_abaqus},
      {"VTK XML", {".vtu"}, read_vtu, false, write_vtu},
      {"VTK legacy", {".vtk"}, read_vtk, false, nullptr},
      {"Vega", {".veg"}, [](const std::string& path) { return read_vega(path); }, true, write_vega},
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

Warnings write_mesh(const LoadedMesh& loaded, const std::string& path, bool replace) {
  namespace fs = std::filesystem;
  const MeshFormat& format = mesh_format_of(path);
  if (!format.write) throw ConfigError(fmt::format("{}: {} files are only read; write .vtu instead", path, format.name));
  const WrittenMesh written = format.write(loaded);
  // The user's spelling for a single file, that of the format for several beside each other.
  const auto place = [&](const MeshText& file) {
    return written.files.size() == 1 ? path : fs::path(path).replace_extension(file.ending).string();
  };
  for (const MeshText& file : written.files) {
    if (!replace && fs::exists(place(file))) throw ConfigError(place(file) + ": is there already; --force replaces it");
  }
  replace_together(written.files, place);
  return written.losses;
}

void scale_mesh(TetMesh& mesh, double factor, const std::string& source) {
  for (Vec3& x : mesh.nodes) x *= factor;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (std::isnormal(signed_volume6(mesh, mesh.tets[e]) / 6)) continue;
    throw ConfigError(fmt::format("{}: scaled by {}, the volume of element {} cannot be represented; check the scale",
                                  source, factor, e));
  }
}

}  // namespace orthodyn
