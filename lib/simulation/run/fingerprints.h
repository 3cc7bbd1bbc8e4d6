// Fingerprints of the inputs of a result other than its text: mesh, input files, program and machine. A changed
// fingerprint makes a stored result invalid.
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

// Also includes the materials and cell data of the mesh file.
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

// Fingerprint of the code: the library file that contains this function, plugins (environment variable
// ORTHODYN_PLUGINS), and the versions of the libraries.
std::string code_fingerprint();

// Fingerprint of the hardware that timings depend on: processor, number of cores, threads of BLAS.
std::string machine_fingerprint();

}  // namespace orthodyn
