#include "lib/study/fingerprint.h"

#include <dlfcn.h>

#include <cstdlib>

#include "lib/core/versions.h"
#include "lib/linear/blas.h"
#include "lib/study/machine.h"

namespace orthodyn {

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
