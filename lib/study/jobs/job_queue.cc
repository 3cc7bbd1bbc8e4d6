#include "lib/study/jobs/job_queue.h"

#include <filesystem>
#include <map>
#include <mutex>

#include "lib/study/jobs/worker_pool.h"

namespace orthodyn::study {

namespace {

// The jobs of each folder, in the order of the first of them.
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

}  // namespace

bool JobQueue::run(const std::vector<Job>& jobs, const JobEvents& events) const {
  const auto groups = by_folder(jobs);
  WorkerPool pool(options_.workers);
  std::mutex telling;
  pool.run(groups.size(), [&](std::size_t group) {
    if (interrupt_) return false;
    const std::size_t first = groups[group].front();
    Json result = finished_result(jobs[first], options_.failures);
    const bool cached = !result.is_null();
    if (!cached) {
      {
        const std::lock_guard lock(telling);
        if (const auto damaged = damaged_file(jobs[first]))
          options_.warn(damaged->string() + " is damaged: done again");
        events.starts(first);
      }
      result = run_job(options_.program, jobs[first], [&] { return interrupt_ || pool.is_stopping(); });
      if (result.is_null()) return false;
    }
    for (const std::size_t i : groups[group]) {
      const std::lock_guard lock(telling);
      events.ends(i, result, cached || i != first);
    }
    return true;
  });
  return !interrupt_;
}

}  // namespace orthodyn::study
