#include "lib/study/sweep/sweep_jobs.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "lib/scene/mesh_materials.h"
#include "lib/scene/scene.h"
#include "lib/simulation/fingerprints.h"
#include "lib/study/sweep/evaluation.h"

namespace orthodyn::study::sweep {

namespace fs = std::filesystem;

namespace {

EvaluationInput input_of(const Sweep& sweep) {
  EvaluationInput input{sweep.quantities, {}, {}, sweep.limits.seconds, code_fingerprint()};
  if (!sweep.frames) return input;
  input.frame = sweep.frames->color.substr(0, sweep.frames->color.find('.'));
  input.frame_at = sweep.frames->at;
  return input;
}

// With what named files bring along: elements beside .node, files that a .veg includes.
std::string mesh_hash(const Point& point) {
  try {
    return mesh_fingerprint(load_mesh(read_scene(Config::from_text(point.scene))));
  } catch (const ConfigError& e) {
    return e.what();  // the point itself will say so
  }
}

}  // namespace

std::vector<std::optional<Job>> jobs_of(const Sweep& sweep, const std::vector<Point>& points, const fs::path& folder) {
  const Json input = to_json(input_of(sweep));
  const ProcessLimits limits{sweep.limits.seconds + kSetUpSeconds, sweep.limits.memory};
  std::map<std::string, std::string> meshes;  // fingerprints by section
  FileFingerprints files;
  std::vector<std::optional<Job>> all;
  for (const auto& point : points) {
    if (!point.impossible.empty()) {
      all.emplace_back();
      continue;
    }
    Fingerprint hash;
    hash.add(point.scene).add(input.dump()).add(fmt::format("{}", sweep.limits.memory));
    for (const auto& file : point.files) hash.add(files.of(file));
    if (!point.files.empty()) {
      std::string& mesh = meshes[point.mesh];
      if (mesh.empty()) mesh = mesh_hash(point);
      hash.add(mesh);
    }
    all.push_back(Job{point.title, "evaluate", folder / "points" / hash.text(), point.scene, input, limits});
  }
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
