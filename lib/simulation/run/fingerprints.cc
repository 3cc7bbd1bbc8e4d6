#include "lib/simulation/run/fingerprints.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "lib/core/versions.h"
#include "lib/linear/blas.h"
#include "lib/simulation/run/machine.h"

namespace orthodyn {

namespace {

template <class T>
std::string bytes(const std::vector<T>& list) {
  return {reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T)};
}

const char* kind_name(MeshMaterial::Kind kind) {
  switch (kind) {
    case MeshMaterial::Kind::isotropic: return "isotropic";
    case MeshMaterial::Kind::orthotropic: return "orthotropic";
    case MeshMaterial::Kind::anisotropic: return "anisotropic";
  }
  return "";
}

// The versions at the first call, because libraries loaded later on demand would change them.
const std::string& versions_of_libraries() {
  static const std::string all = [] {
    std::string text;
    for (const auto& [library, version] : library_versions()) text += library + " " + version + "\n";
    return text;
  }();
  return all;
}

}  // namespace

std::string mesh_fingerprint(const Mesh& mesh) {
  Fingerprint print;
  print.add(bytes(mesh.nodes))
      .add(bytes(mesh.cells.shapes()))
      .add(bytes(mesh.cells.nodes()))
      .add(bytes(mesh.region_of));
  print.add(std::to_string(mesh.region_names.size()));
  for (const auto& name : mesh.region_names) print.add(name);
  print.add(std::to_string(mesh.surfaces.size()));
  for (const auto& [name, faces] : mesh.surfaces) print.add(name).add(bytes(faces));
  for (const auto& [name, nodes] : mesh.node_sets) print.add(name).add(bytes(nodes));
  if (!mesh.cell_of.empty()) print.add("cut from").add(bytes(mesh.cell_of));
  return print.text();
}

std::string mesh_fingerprint(const LoadedMesh& loaded) {
  Fingerprint print;
  print.add(mesh_fingerprint(loaded.mesh));
  for_each_material(loaded, [&](const std::string& region, const MeshMaterial& m) {
    print.add(region).add(m.name).add(kind_name(m.kind)).add(m.problem);
    std::vector<double> constants{m.density, m.nu12, m.nu23, m.nu31, m.g12, m.g23, m.g31};
    constants.insert(constants.end(), m.young.begin(), m.young.end());
    constants.insert(constants.end(), m.axes.data(), m.axes.data() + m.axes.size());
    if (m.kind == MeshMaterial::Kind::anisotropic)
      constants.insert(constants.end(), m.stiffness.begin(), m.stiffness.end());
    print.add(bytes(constants));
  });
  for (const auto& [region, layup] : loaded.layups)
    for (const MeshPly& ply : layup.plies) print.add(bytes(std::vector<double>{ply.degrees, ply.thickness}));
  for (const auto& data : loaded.cell_data)
    print.add(data.name).add(std::to_string(data.components)).add(bytes(data.values));
  return print.text();
}

const std::string& FileFingerprints::of(const std::filesystem::path& file) {
  std::error_code ignored;  // an unreadable file throws below
  const auto changed = std::filesystem::last_write_time(file, ignored);
  const auto size = std::filesystem::file_size(file, ignored);
  Known& known = known_[file];
  if (known.print.empty() || known.changed != changed || known.size != size)
    known = {changed, size, Fingerprint().add_file(file).text()};
  return known.print;
}

std::string code_fingerprint() {
  Fingerprint print;
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&code_fingerprint), &info) != 0 && info.dli_fname) {
    print.add_file(info.dli_fname);
    const auto beside = std::filesystem::path(info.dli_fname).parent_path() / "liborthodyn_petsc.so";
    if (std::error_code ec; std::filesystem::is_regular_file(beside, ec)) print.add_file(beside);
  }
  const char* plugins = std::getenv("ORTHODYN_PLUGINS");
  std::istringstream listed(plugins ? plugins : "");
  for (std::string file; std::getline(listed, file, ':');) {
    print.add(file);
    // A plugin found on the loader's path contributes its name only.
    if (std::error_code ec; std::filesystem::is_regular_file(file, ec)) print.add_file(file);
  }
  return print.add(orthodyn_version()).add(blas_name()).add(versions_of_libraries()).text();
}

std::string machine_fingerprint() {
  Fingerprint print;
  print.add(machine_json().dump());
  for (const char* variable : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"}) {
    const char* value = std::getenv(variable);
    print.add(value ? value : "");
  }
  return print.text();
}

}  // namespace orthodyn
