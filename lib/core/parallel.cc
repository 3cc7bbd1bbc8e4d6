#include "lib/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <exception>
#include <mutex>

namespace orthodyn {

// Threads start with the first loop. `limit` allows more threads than the machine has.
struct LoopArena {
  explicit LoopArena(int n)
      : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(n)), tasks(n) {}
  tbb::global_control limit;
  tbb::task_arena tasks;
};

namespace {

// Keeps the exception of the smallest index, whatever the order of the threads.
class FirstError {
 public:
  void keep(int index, std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (error_ && index_ < index) return;
    index_ = index;
    error_ = std::move(error);
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  int index_ = 0;
  std::exception_ptr error_;
};

thread_local LoopArena* arena_of_this_thread = nullptr;

}  // namespace

int available_threads() { return tbb::info::default_concurrency(); }

LoopThreads::LoopThreads(int n)
    : arena_(n > 1 ? std::make_unique<LoopArena>(n) : nullptr), before_(arena_of_this_thread) {
  arena_of_this_thread = arena_.get();
}

LoopThreads::~LoopThreads() { arena_of_this_thread = before_; }

int loop_threads() { return arena_of_this_thread ? arena_of_this_thread->tasks.max_concurrency() : 1; }

void parallel_for(int n, const std::function<void(int)>& body) {
  if (n == 1 || !arena_of_this_thread) {
    for (int i = 0; i < n; ++i) body(i);
    return;
  }
  FirstError first;
  const auto guarded = [&](int i) {
    try {
      body(i);
    } catch (...) {
      first.keep(i, std::current_exception());
    }
  };
  arena_of_this_thread->tasks.execute([&] { tbb::parallel_for(0, n, guarded, tbb::simple_partitioner()); });
  first.rethrow();
}

}  // namespace orthodyn
