// Fingerprints of what figures depend on besides their input: the program and the machine.
#pragma once

#include <string>

#include "lib/core/fingerprint.h"

namespace orthodyn {

// Of the code that integrates: the file that holds this function, and the versions of the libraries.
std::string code_fingerprint();

// Of what times depend on besides: processor, number of cores, threads of BLAS.
std::string machine_fingerprint();

}  // namespace orthodyn
