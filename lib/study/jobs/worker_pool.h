// Tasks by number, done by several threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>

namespace orthodyn::study {

class WorkerPool {
 public:
  // At least one worker: the thread that calls run().
  explicit WorkerPool(int workers) : workers_(workers) {}

  // Calls task(0) ... task(count - 1), begun in this order, each once. A task that returns false ends the work of its
  // worker. Once a task has thrown no other begins; the first exception is thrown here, when all have ended.
  void run(std::size_t count, const std::function<bool(std::size_t)>& task);

  // True once a task has thrown: those in progress are to give up.
  bool is_stopping() const { return stop_; }

 private:
  void work(std::size_t count, const std::function<bool(std::size_t)>& task);

  int workers_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

}  // namespace orthodyn::study
