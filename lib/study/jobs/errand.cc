#include "lib/study/jobs/errand.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <fstream>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "lib/core/errors.h"
#include "lib/simulation/files.h"
#include "lib/study/jobs/deadline.h"
#include "lib/study/compare/measure.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

constexpr const char* kCrashed = "crashed";

bool has(const Json& result, const char* key, const char* word) {
  return result.is_object() && result.contains(key) && result.at(key) == word;
}

std::string last_line(const fs::path& file) {
  std::ifstream in(file);
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) last = line;
  return last;
}

Json died(const ProcessEnd& end, const fs::path& log) {
  const auto failed = [](const std::string& reason, const std::string& message) {
    return Json{{"status", "failed"}, {"reason", reason}, {"message", message}};
  };
  if (end.kind == ProcessEnd::Kind::timed_out) return failed(kTimeLimit, "killed after the limit of the wall time");
  if (end.kind == ProcessEnd::Kind::out_of_memory)
    return failed(reason_name(Reason::out_of_memory), "killed when it used more than the limit of memory");
  const std::string said = last_line(log);
  const std::string how = end.kind == ProcessEnd::Kind::signalled
                              ? fmt::format("ended by signal {} ({})", end.code, strsignal(end.code))
                              : fmt::format("ended with code {}", end.code);
  return failed(kCrashed, how + (said.empty() ? "" : ": " + said));
}

// Takes errands one by one, from as many threads as there are jobs. A thread must outlive the processes that it
// starts: they die with it.
class Crew {
 public:
  Crew(const std::string& program, const std::vector<Errand>& errands, const std::atomic<bool>& interrupt,
       const ErrandEvents& events, OldFailures failures)
      : program_(program), errands_(errands), interrupt_(interrupt), events_(events), failures_(failures) {
    std::map<fs::path, std::size_t> work_of;
    for (std::size_t i = 0; i < errands.size(); ++i) {
      const auto [known, is_new] = work_of.emplace(errands[i].folder, work_.size());
      if (is_new) work_.emplace_back();
      work_[known->second].push_back(i);
    }
  }

  bool work(int jobs) {
    std::vector<std::jthread> threads;
    try {
      for (int i = 1; i < jobs; ++i) threads.emplace_back([this] { take_turns(); });
    } catch (...) {  // no further thread can be had
      stop_ = true;
      throw;
    }
    take_turns();
    threads.clear();
    if (failure_) std::rethrow_exception(failure_);
    return !interrupt_;
  }

 private:
  void take_turns() {
    try {
      for (std::size_t k = next_++; k < work_.size() && !stop_; k = next_++)
        if (!take(work_[k])) return;
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      stop_ = true;
    }
  }

  bool take(const std::vector<std::size_t>& same) {
    if (interrupt_) return false;
    const Errand& errand = errands_[same.front()];
    Json result = finished(errand.folder, failures_);
    const bool cached = !result.is_null();
    if (!cached) {
      tell([&] { events_.starts(same.front()); });
      result = carry_out(program_, errand, [this] { return interrupt_ || stop_; });
      if (result.is_null()) return false;
    }
    for (const std::size_t i : same) tell([&] { events_.ends(i, result, cached || i != same.front()); });
    return true;
  }

  template <class Event>
  void tell(const Event& event) {
    const std::lock_guard lock(mutex_);
    event();
  }

  const std::string& program_;
  const std::vector<Errand>& errands_;
  const std::atomic<bool>& interrupt_;
  const ErrandEvents& events_;
  const OldFailures failures_;
  std::vector<std::vector<std::size_t>> work_;  // errands by folder
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

}  // namespace

Json finished(const fs::path& folder, OldFailures failures) {
  Json result = read_json(folder / kResultFile);
  if (!result.is_object() || has(result, "reason", kCrashed)) return nullptr;
  if (failures == OldFailures::retry && has(result, "status", "failed")) return nullptr;
  return result;
}

bool met_a_limit(const Json& result) {
  return has(result, "status", "failed") &&
         (has(result, "reason", kTimeLimit) || has(result, "reason", reason_name(Reason::out_of_memory)));
}

std::size_t number_at_limits(const std::vector<Errand>& errands) {
  std::set<fs::path> folders;
  for (const auto& errand : errands)
    if (!errand.command.empty()) folders.insert(errand.folder);
  return static_cast<std::size_t>(std::count_if(folders.begin(), folders.end(), [](const fs::path& folder) {
    return met_a_limit(read_json(folder / kResultFile));
  }));
}

Json carry_out(const std::string& program, const Errand& errand, const Stop& stop) {
  const fs::path& folder = errand.folder;
  write_file(folder / kSceneFile, {"# " + errand.title + "\n" + errand.scene});
  write_file(folder / kJobFile, {to_text(errand.job, 2)});
  std::error_code ignored;
  fs::remove(folder / kResultFile, ignored);
  const fs::path log = folder / "log.txt";
  const ProcessEnd end = run_process({program, errand.command, folder.string()}, log, errand.limits, stop);
  if (end.kind == ProcessEnd::Kind::interrupted) return nullptr;
  Json result = read_json(folder / kResultFile);
  if (result.is_object()) return result;
  result = died(end, log);
  write_file(folder / kResultFile, {to_text(result)});
  return result;
}

bool carry_out_all(const std::string& program, const std::vector<Errand>& errands, int jobs,
                   const std::atomic<bool>& interrupt, const ErrandEvents& events, OldFailures failures) {
  return Crew(program, errands, interrupt, events, failures).work(jobs);
}

}  // namespace orthodyn
