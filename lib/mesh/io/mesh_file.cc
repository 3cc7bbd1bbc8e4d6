#include "lib/mesh/io/mesh_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <system_error>
#include <utility>
#include <vector>

#include "lib/core/errors.h"
#include "lib/core/spelling.h"
#include "lib/core/utf8.h"
#include "lib/core/write_file.h"
#include "lib/mesh/io/mesh_format.h"

namespace orthodyn {
namespace {

// Writes all files beside their targets before the first one replaces its target.
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
    throw ConfigError(place(file), fmt::format("cannot be written: {}", reason));
  }
  for (const MeshText& file : files) {
    std::error_code error;
    fs::rename(beside(file), place(file), error);
    if (error)
      throw ConfigError(place(file),
                        fmt::format("cannot be written: {}; the mesh is in {}", error.message(), beside(file)));
  }
}

// Converts names and collects the converted ones.
class Names {
 public:
  explicit Names(const std::string& path) : path_(path) {}

  void convert(std::string& name) {
    if (find_invalid_utf8(name) == std::string::npos) return;
    name = utf8_from_latin1(name);
    converted_.push_back(name);
  }

  template <class V>
  void convert_keys(std::map<std::string, V>& map) {
    std::map<std::string, V> out;
    for (auto& [name, value] : map) {
      std::string key = name;
      convert(key);
      if (!out.emplace(key, std::move(value)).second)
        throw ConfigError(path_, fmt::format("two names become '{}' when read as Latin-1, because they are not UTF-8; "
                                             "rename one, or save the file as UTF-8",
                                             key));
    }
    map = std::move(out);
  }

  const std::vector<std::string>& converted() const { return converted_; }

 private:
  const std::string& path_;
  std::vector<std::string> converted_;
};

}  // namespace

void make_names_utf8(LoadedMesh& loaded, const std::string& path) {
  Names names(path);
  for (std::string& name : loaded.mesh.region_names) names.convert(name);
  names.convert_keys(loaded.mesh.surfaces);
  names.convert_keys(loaded.mesh.node_sets);
  names.convert_keys(loaded.materials);
  names.convert_keys(loaded.layups);
  for_each_material(loaded, [&](const std::string&, MeshMaterial& material) { names.convert(material.name); });
  for (CellData& data : loaded.cell_data) names.convert(data.name);
  if (!names.converted().empty())
    loaded.warnings.push_back(
        fmt::format("{}: names that are not UTF-8 were read as Latin-1: {}", path, join(names.converted())));
}

LoadedMesh read_mesh(const std::string& path, FileCells cells) {
  LoadedMesh loaded = mesh_format_of(path).read(path, cells);
  make_names_utf8(loaded, path);
  return loaded;
}

Warnings write_mesh(const LoadedMesh& loaded, const std::string& path, bool replace) {
  namespace fs = std::filesystem;
  const MeshFormat& format = mesh_format_to_write(path);
  if (!format.write) throw ConfigError(path, fmt::format("{} files can be read only; write .vtu instead", format.name));
  WrittenMesh written = format.write(loaded);
  // A single file gets the name the user gave, several files get the endings of the format.
  const auto place = [&](const MeshText& file) {
    return written.files.size() == 1 ? path : fs::path(path).replace_extension(file.ending).string();
  };
  for (const MeshText& file : written.files)
    if (!replace && fs::exists(place(file))) throw ConfigError(place(file), "already exists; --force replaces it");
  replace_together(written.files, place);
  for (std::string& loss : losses_in(format, loaded)) written.losses.push_back(std::move(loss));
  return std::move(written.losses);
}

void scale_mesh(Mesh& mesh, double factor, const std::string& source) {
  for (Vec3& x : mesh.nodes) x *= factor;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    if (std::isnormal(cell_volume(mesh, e))) continue;
    throw ConfigError(
        source,
        fmt::format("scaled by {}, the volume of element {} cannot be represented; check the scale", factor, e));
  }
}

void convert_to_si(LoadedMesh& loaded, FileUnits units, const std::string& source) {
  if (units == FileUnits::si) return;
  const UnitFactors factors = factors_of(units);
  scale_mesh(loaded.mesh, factors.length, source);
  for_each_material(loaded, [&](const std::string&, MeshMaterial& m) {
    m.density *= factors.density;
    m.young *= factors.stress;
    for (double* modulus : {&m.g12, &m.g23, &m.g31}) *modulus *= factors.stress;
    for (double& entry : m.stiffness) entry *= factors.stress;
  });
  for (auto& [region, layup] : loaded.layups)
    for (MeshPly& ply : layup.plies) ply.thickness *= factors.length;
}

}  // namespace orthodyn
