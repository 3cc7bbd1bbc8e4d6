// Parallel loops over the threads of this process (oneTBB). Loop bodies only read shared data, so that results do not
// depend on the number of threads.
#pragma once

#include <functional>
#include <memory>

namespace orthodyn {

// The number of threads that the machine offers this process.
int available_threads();

struct LoopArena;

// While an object exists, loops started by this thread run on n threads; other threads have their own setting. Objects
// may be nested: the destructor restores the previous number. Must not be created or destroyed within a loop.
class LoopThreads {
 public:
  // Precondition: n >= 1.
  explicit LoopThreads(int n);
  ~LoopThreads();
  LoopThreads(const LoopThreads&) = delete;
  LoopThreads& operator=(const LoopThreads&) = delete;

 private:
  std::unique_ptr<LoopArena> arena_;  // null for one thread
  LoopArena* before_;
};

// The number of threads of loops started by this thread; 1 if it has no LoopThreads.
int loop_threads();

// Calls body(i) for all i in [0, n): in order with one thread, otherwise concurrently in any order. Returns when all
// calls have ended; rethrows the exception of the smallest i.
void parallel_for(int n, const std::function<void(int)>& body);

}  // namespace orthodyn
