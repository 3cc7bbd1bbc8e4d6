// Fingerprints of what figures depend on besides the text of their input: the mesh, the program and the
// machine.
#pragma once

#include <string>

#include "lib/core/fingerprint.h"
#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

// Of nodes, elements, regions, surfaces and sets of nodes, whatever files they came from.
std::string mesh_fingerprint(const TetMesh& mesh);

// Of the code that integrates: the file that holds this function, and the versions of the libraries.
std::string code_fingerprint();

// Of what times depend on besides: processor, number of cores, threads of BLAS.
std::string machine_fingerprint();

}  // namespace orthodyn
