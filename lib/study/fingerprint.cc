#include "lib/study/fingerprint.h"

#include <dlfcn.h>

#include <cstdlib>

#include "lib/core/versions.h"
#include "lib/linear/blas.h"
#include "lib/study/machine.h"

namespace orthodyn {

namespace {

// Of plain numbers.
template <class T>
std::string bytes(const std::vector<T>& list) {
  return {reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T)};
}

}  // namespace

std::string mesh_fingerprint(const TetMesh& mesh) {
  Fingerprint print;
  print.add(bytes(mesh.nodes)).add(bytes(mesh.tets)).add(bytes(mesh.region_of));
  print.add(std::to_string(mesh.region_names.size()));
  for (const auto& name : mesh.region_names) print.add(name);
  print.add(std::to_string(mesh.surfaces.size()));
  for (const auto& [name, triangles] : mesh.surfaces) print.add(name).add(bytes(triangles));
  for (const auto& [name, nodes] : mesh.node_sets) print.add(name).add(bytes(nodes));
  return print.text();
}

std::string code_fingerprint() {
  Fingerprint print;
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&code_fingerprint), &info) != 0 && info.dli_fname)
    print.add_file(info.dli_fname);
  print.add(orthodyn_version()).add(blas_name());
  for (const auto& [library, version] : library_versions()) print.add(library + " " + version);
  return print.text();
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
