#include "lib/linear/openmp.h"

#include <dlfcn.h>

namespace orthodyn {

namespace {

// Of the library that others have loaded: ours uses none.
struct Levels {
  int (*const get)() = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "omp_get_max_active_levels"));
  void (*const set)(int) = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, "omp_set_max_active_levels"));
};

const Levels& active_levels() {
  static const Levels levels;
  return levels;
}

}  // namespace

SerialOpenMp::SerialOpenMp() {
  if (!active_levels().set || !active_levels().get) return;
  levels_ = active_levels().get();
  active_levels().set(0);
}

SerialOpenMp::~SerialOpenMp() {
  if (active_levels().set && active_levels().get) active_levels().set(levels_);
}

}  // namespace orthodyn
