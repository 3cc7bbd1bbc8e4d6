// Loops on several threads of this process (oneTBB). Results must not depend on how many there are: what bodies share
// they only read.
#pragma once

#include <functional>
#include <memory>

namespace orthodyn {

// As many as the machine gives this process.
int available_threads();

struct LoopArena;

// While it lives, the loops that this thread begins run on n threads; other threads have their own numbers. Objects are
// nested: the end of one brings back the number before it. Not to be made or ended within a loop.
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

// Of the loops that this thread begins: 1 without an object of LoopThreads.
int loop_threads();

// body(i) for all i in [0, n): on this thread in order where there is one, else in any order at the same time. Returns
// when all are done; throws what the first of them threw, in the order of i.
void parallel_for(int n, const std::function<void(int)>& body);

}  // namespace orthodyn
