#include "lib/linear/blas.h"

#include <dlfcn.h>

#include <mutex>

namespace orthodyn {

namespace {

// BLAS is chosen when the program is loaded, not when it is built: ask for the symbols by name.
template <class Function>
Function* find(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

struct ThreadFunctions {
  int (*get)();
  void (*set)(int);
};

const ThreadFunctions& find_threads() {
  static const ThreadFunctions functions{find<int()>("openblas_get_num_threads"),
                                         find<void(int)>("openblas_set_num_threads")};
  return functions;
}

// OpenBLAS has one number of threads for the whole process.
struct ThreadCount {
  std::mutex mutex;
  int holders = 0;  // objects that ask for one thread
  int before = 0;   // threads without them
};

ThreadCount& thread_count() {
  static ThreadCount count;
  return count;
}

}  // namespace

std::string blas_name() {
  if (auto* config = find<char*()>("openblas_get_config")) return config();
  return "unknown (not OpenBLAS)";
}

bool blas_is_openblas() { return find<char*()>("openblas_get_config") != nullptr; }

void limit_blas_threads(int most) {
  const auto [get, set] = find_threads();
  if (get && set && get() > most) set(most);
}

OneBlasThread::OneBlasThread(bool one) : held_(one && find_threads().get && find_threads().set) {
  if (!held_) return;
  ThreadCount& threads = thread_count();
  const std::lock_guard lock(threads.mutex);
  if (threads.holders++ > 0) return;
  threads.before = find_threads().get();
  if (threads.before > 1) find_threads().set(1);
}

OneBlasThread::~OneBlasThread() {
  if (!held_) return;
  ThreadCount& threads = thread_count();
  const std::lock_guard lock(threads.mutex);
  if (--threads.holders == 0 && threads.before > 1) find_threads().set(threads.before);
}

}  // namespace orthodyn
