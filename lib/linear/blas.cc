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

OneBlasThread::OneBlasThread(bool one) {
  static auto* get = find<int()>("openblas_get_num_threads");
  static auto* set = find<void(int)>("openblas_set_num_threads");
  if (!one || !get || !set || get() == 1) return;
  before_ = get();
  set(1);
}

OneBlasThread::~OneBlasThread() {
  static auto* set = find<void(int)>("openblas_set_num_threads");
  if (before_ > 0) set(before_);
}

}  // namespace orthodyn
