// The jobs of a sweep, one per point.
#include <algorithm>
#include <set>

#include "lib/study/points/evaluation.h"
#include "lib/study/sweep/sweep_table.h"

namespace orthodyn::study::sweep {

namespace fs = std::filesystem;

namespace {

EvaluationInput input_of(const Sweep& sweep) {
  EvaluationInput input{sweep.quantities, {}, {}, sweep.limits.seconds, code_fingerprint()};
  input.mesh_error = std::any_of(sweep.quantities.begin(), sweep.quantities.end(),
                                 [](const auto& named) { return named.second.cost.empty(); });
  if (!sweep.frames) return input;
  input.frame = sweep.frames->color.substr(0, sweep.frames->color.find('.'));
  input.frame_at = sweep.frames->at;
  return input;
}

}  // namespace

std::vector<std::optional<Job>> jobs_of(const Sweep& sweep, const std::vector<Point>& points, const fs::path& folder,
                                        int ranks) {
  PointJobs jobs(input_of(sweep), sweep.limits, folder, ranks);
  std::vector<std::optional<Job>> all;
  for (const auto& point : points)
    all.push_back(point.impossible.empty() ? std::optional(jobs.job(point.scene)) : std::nullopt);
  return all;
}

std::vector<Job> distinct(const std::vector<std::optional<Job>>& jobs) {
  std::set<fs::path> seen;
  std::vector<Job> out;
  for (const auto& job : jobs)
    if (job && seen.insert(job->folder).second) out.push_back(*job);
  return out;
}

std::vector<Job> slice(const std::vector<Job>& jobs, std::size_t part, std::size_t parts) {
  std::vector<Job> out;
  for (std::size_t i = part - 1; i < jobs.size(); i += parts) out.push_back(jobs[i]);
  return out;
}

}  // namespace orthodyn::study::sweep
