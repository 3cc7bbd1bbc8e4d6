#include "lib/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <memory>

namespace orthodyn {

namespace {

// Its threads are made with the first loop; null for one thread.
struct Team {
  explicit Team(int n) : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(n)), arena(n) {}
  tbb::global_control limit;
  tbb::task_arena arena;
};

std::unique_ptr<Team>& team() {
  static std::unique_ptr<Team> all;
  return all;
}

}  // namespace

int available_threads() { return tbb::info::default_concurrency(); }

void set_threads(int n) {
  team().reset();
  if (n > 1) team() = std::make_unique<Team>(n);
}

int threads() { return team() ? team()->arena.max_concurrency() : 1; }

void parallel_for(int n, const std::function<void(int)>& body) {
  if (n == 1 || !team()) {
    for (int i = 0; i < n; ++i) body(i);
    return;
  }
  team()->arena.execute([&] { tbb::parallel_for(0, n, body, tbb::simple_partitioner()); });
}

}  // namespace orthodyn
