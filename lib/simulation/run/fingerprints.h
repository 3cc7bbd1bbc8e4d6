// Fingerprints of what figures depend on besides the text of their input: the mesh, the program and the
// machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "lib/core/fingerprint.h"
#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

// Of nodes, elements, regions, surfaces and sets of nodes, whatever files they came from.
std::string mesh_fingerprint(const TetMesh& mesh);

// The same with what the files say of materials and of elements.
std::string mesh_fingerprint(const LoadedMesh& loaded);

// Of files, each of them read once for as long as its size and its time of change stay the same.
class FileFingerprints {
 public:
  // Throws RunError if it cannot be read.
  const std::string& of(const std::filesystem::path& file);

 private:
  struct Known {
    std::filesystem::file_time_type changed;
    std::uintmax_t size = 0;
    std::string print;
  };
  std::map<std::filesystem::path, Known> known_;
};

// Of the code that integrates: the file that holds this function, plugins (of the environment variable
// ORTHODYN_PLUGINS), and the versions of the libraries.
std::string code_fingerprint();

// Of what times depend on besides: processor, number of cores, threads of BLAS.
std::string machine_fingerprint();

}  // namespace orthodyn
