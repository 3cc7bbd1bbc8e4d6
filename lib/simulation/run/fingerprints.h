// Fingerprints of a result's inputs besides the scene text: mesh, files, program and machine. A result with another
// fingerprint is outdated.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "lib/core/fingerprint.h"
#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

// Fingerprint of nodes, elements, regions, surfaces and node sets; independent of the file format.
std::string mesh_fingerprint(const Mesh& mesh);

// Also includes the materials, layups and cell data of the mesh file.
std::string mesh_fingerprint(const LoadedMesh& loaded);

// Fingerprints of files. A file is read again only if its size or modification time has changed.
class FileFingerprints {
 public:
  // Throws RunError if the file cannot be read.
  const std::string& of(const std::filesystem::path& file);

 private:
  struct Known {
    std::filesystem::file_time_type changed;
    std::uintmax_t size = 0;
    std::string print;
  };
  std::map<std::filesystem::path, Known> known_;
};

// Fingerprint of the code: orthodyn's library files, plugins (environment variable ORTHODYN_PLUGINS), and the versions
// of other libraries.
std::string code_fingerprint();

// Fingerprint of the conditions of timings: machine_json() and the threads of BLAS.
std::string machine_fingerprint();

}  // namespace orthodyn
