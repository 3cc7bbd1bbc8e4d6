#include "lib/study/jobs/job_queue.h"

#include <exception>
#include <filesystem>
#include <map>
#include <mutex>
#include <thread>

namespace orthodyn::study {

namespace {

// Indices of the jobs in each folder, ordered by the first job of the folder.
std::vector<std::vector<std::size_t>> by_folder(const std::vector<Job>& jobs) {
  std::vector<std::vector<std::size_t>> groups;
  std::map<std::filesystem::path, std::size_t> group_of;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto [known, is_new] = group_of.emplace(jobs[i].folder, groups.size());
    if (is_new) groups.emplace_back();
    groups[known->second].push_back(i);
  }
  return groups;
}

// Runs numbered tasks in several threads.
class WorkerPool {
 public:
  // At least one worker: the thread that calls run().
  explicit WorkerPool(int workers) : workers_(workers) {}

  // Calls task(0) ... task(count - 1) once each, started in this order. A task that returns false ends its worker.
  // After an exception no further task starts; the first exception is rethrown when all tasks have ended.
  void run(std::size_t count, const std::function<bool(std::size_t)>& task);

  // True after an exception: tasks in progress should stop.
  bool is_stopping() const { return stop_; }

 private:
  void work(std::size_t count, const std::function<bool(std::size_t)>& task);

  int workers_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

void WorkerPool::run(std::size_t count, const std::function<bool(std::size_t)>& task) {
  next_ = 0;
  std::vector<std::jthread> threads;
  try {
    for (int i = 1; i < workers_; ++i) threads.emplace_back([&] { work(count, task); });
  } catch (...) {  // no further thread can be started
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

}  // namespace

bool JobQueue::run(const std::vector<Job>& jobs, const JobEvents& events) const {
  const auto groups = by_folder(jobs);
  WorkerPool pool(options_.workers);
  std::mutex reporting;
  pool.run(groups.size(), [&](std::size_t group) {
    if (interrupt_) return false;
    const std::size_t first = groups[group].front();
    Json result = finished_result(jobs[first], options_.failures);
    const bool cached = !result.is_null();
    if (!cached) {
      {
        const std::lock_guard lock(reporting);
        if (const auto damaged = damaged_file(jobs[first]))
          options_.warn(damaged->string() + " is damaged; the job is repeated");
        events.starts(first);
      }
      result = run_job(options_.program, jobs[first], [&] { return interrupt_ || pool.is_stopping(); });
      if (result.is_null()) return false;
    }
    for (const std::size_t i : groups[group]) {
      const std::lock_guard lock(reporting);
      events.ends(i, result, cached || i != first);
    }
    return true;
  });
  return !interrupt_;
}

}  // namespace orthodyn::study
