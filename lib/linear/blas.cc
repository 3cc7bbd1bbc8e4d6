#include "lib/linear/blas.h"

#include <dlfcn.h>

namespace orthodyn {

namespace {

// BLAS is chosen when the program is loaded, not when it is built: ask for the symbols by name.
template <class Function>
Function* find(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

}  // namespace

std::string blas_name() {
  if (auto* config = find<char*()>("openblas_get_config")) return config();
  return "unknown (not OpenBLAS)";
}

bool blas_is_openblas() { return find<char*()>("openblas_get_config") != nullptr; }

void set_blas_threads(int threads) {
  if (auto* set = find<void(int)>("openblas_set_num_threads")) set(threads);
}

}  // namespace orthodyn
