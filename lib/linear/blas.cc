#include "lib/linear/blas.h"

#include <dlfcn.h>

#include <algorithm>
#include <mutex>
#include <set>

namespace orthodyn {

namespace {

// BLAS and OpenMP are chosen when the program is loaded, not when it is built, so symbols are looked up by name.
template <class Function>
Function* find(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

// The number of OpenBLAS threads, which is global to the process.
class ThreadCount {
 public:
  void limit(int most) {
    const std::lock_guard lock(mutex_);
    if (!set_ || !get_) return;
    if (limits_.empty()) free_ = get_();
    limits_.insert(most);
    apply();
  }
  void release(int most) {
    const std::lock_guard lock(mutex_);
    if (!set_ || !get_) return;
    limits_.erase(limits_.find(most));
    apply();
  }

 private:
  void apply() {
    const int count = limits_.empty() ? free_ : std::min(free_, *limits_.begin());
    if (get_() != count) set_(count);
  }

  int (*const get_)() = find<int()>("openblas_get_num_threads");
  void (*const set_)(int) = find<void(int)>("openblas_set_num_threads");
  std::mutex mutex_;
  std::multiset<int> limits_;
  int free_ = 0;  // number of threads without limits
};

ThreadCount& thread_count() {
  static ThreadCount count;
  return count;
}

struct Levels {
  int (*const get)() = find<int()>("omp_get_max_active_levels");
  void (*const set)(int) = find<void(int)>("omp_set_max_active_levels");
};

const Levels& active_levels() {
  static const Levels levels;
  return levels;
}

}  // namespace

std::string blas_name() {
  if (auto* config = find<char*()>("openblas_get_config")) return config();
  return "unknown (not OpenBLAS)";
}

bool blas_is_openblas() { return find<char*()>("openblas_get_config") != nullptr; }

bool blas_uses_openmp() {
  constexpr int kOpenMp = 2;  // OPENBLAS_OPENMP of its cblas.h
  auto* parallel = find<int()>("openblas_get_parallel");
  return parallel != nullptr && parallel() == kOpenMp;
}

BlasThreadLimit::BlasThreadLimit(std::optional<int> most) : most_(most) {
  if (most_) thread_count().limit(*most_);
}

BlasThreadLimit::~BlasThreadLimit() {
  if (most_) thread_count().release(*most_);
}

SerialOpenMp::SerialOpenMp() {
  if (!active_levels().set || !active_levels().get) return;
  levels_ = active_levels().get();
  active_levels().set(0);
}

SerialOpenMp::~SerialOpenMp() {
  if (active_levels().set && active_levels().get) active_levels().set(levels_);
}

}  // namespace orthodyn
