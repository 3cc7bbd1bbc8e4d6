#include "lib/study/jobs/worker_pool.h"

#include <thread>
#include <vector>

namespace orthodyn::study {

void WorkerPool::run(std::size_t count, const std::function<bool(std::size_t)>& task) {
  next_ = 0;
  std::vector<std::jthread> threads;
  try {
    for (int i = 1; i < workers_; ++i) threads.emplace_back([&] { work(count, task); });
  } catch (...) {  // no further thread can be had
    stop_ = true;
    throw;
  }
  work(count, task);
  threads.clear();
  if (failure_) std::rethrow_exception(failure_);
}

void WorkerPool::work(std::size_t count, const std::function<bool(std::size_t)>& task) {
  try {
    for (std::size_t k = next_++; k < count && !stop_; k = next_++)
      if (!task(k)) return;
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
    stop_ = true;
  }
}

}  // namespace orthodyn::study
