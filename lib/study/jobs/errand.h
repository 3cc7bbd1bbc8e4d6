// A piece of work in a process of its own: a folder with its input, in which `PROGRAM COMMAND FOLDER` leaves
// result.json. What is finished is on disk and is not done again.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lib/study/compare/point_result.h"
#include "lib/study/jobs/process.h"

namespace orthodyn {

// A process is killed when it has had the time of its runs and this much more for the set-up, s.
inline constexpr double kSetUpTime = 60;

struct Errand {
  std::string title;              // "damped_beam, cvode_bdf, rtol 1e-3"
  std::string command;            // "measure"
  std::filesystem::path folder;
  std::string scene;              // scene.yaml, in YAML
  Json job;                       // job.json
  ProcessLimits limits;
};

// What to do about the failures of an earlier run.
enum class OldFailures { keep, retry };

// The result that is there; null if there is none, or one of a process that died for no reason of ours: that may
// have had a cause that is gone by now. Null for every failure that is to be tried again.
Json finished(const std::filesystem::path& folder, OldFailures failures = OldFailures::keep);

// A failure at the limit of time or memory: with more of either, or on another machine, it may get through.
bool met_a_limit(const Json& result);

// How many of them there are, each folder counted once.
std::size_t number_at_limits(const std::vector<Errand>& errands);

// Does it. A process that died or reached a limit is a result: {"status": "failed", "reason", "message"}. Null if
// interrupted. Throws RunError if files cannot be written or no process can be started.
Json carry_out(const std::string& program, const Errand& errand, const Stop& stop);

// What those who wait for errands see: an index, and the result once there is one.
struct ErrandEvents {
  std::function<void(std::size_t)> starts;
  std::function<void(std::size_t, const Json&, bool cached)> ends;
};

// Carries them out, `jobs` at a time; those that share a folder are one piece of work, done once. Events come one after
// the other, in no order. False if interrupted. Throws what an event or carry_out() throws; those in progress are given
// up then.
bool carry_out_all(const std::string& program, const std::vector<Errand>& errands, int jobs,
                   const std::atomic<bool>& interrupt, const ErrandEvents& events,
                   OldFailures failures = OldFailures::keep);

}  // namespace orthodyn
