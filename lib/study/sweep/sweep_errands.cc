#include "lib/study/sweep/sweep_errands.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "lib/scene/mesh_materials.h"
#include "lib/study/sweep/evaluate.h"
#include "lib/simulation/fingerprints.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

PointJob job_of(const Sweep& sweep) {
  PointJob job{sweep.quantities, {}, {}, sweep.limits.seconds, code_fingerprint()};
  if (!sweep.frames) return job;
  job.frame = sweep.frames->color.substr(0, sweep.frames->color.find('.'));
  job.frame_at = sweep.frames->at;
  return job;
}

// With what named files bring along: elements beside .node, files that a .veg includes.
std::string print_of_mesh(const SweepPoint& point) {
  try {
    return mesh_fingerprint(load_mesh(read_scene(Config::from_text(point.scene))));
  } catch (const ConfigError& e) {
    return e.what();  // the point itself will say so
  }
}

}  // namespace

std::vector<Errand> errands_of(const Sweep& sweep, const std::vector<SweepPoint>& points, const fs::path& folder) {
  const Json job = job_of(sweep).json();
  std::map<std::string, std::string> meshes;
  FileFingerprints files;
  std::vector<Errand> all;
  for (const auto& point : points) {
    if (!point.impossible.empty()) {
      all.push_back({point.title, "", {}, "", nullptr, {}});
      continue;
    }
    Fingerprint print;
    print.add(point.scene).add(job.dump()).add(fmt::format("{}", sweep.limits.memory));
    for (const auto& file : point.files) print.add(files.of(file));
    if (!point.files.empty()) {
      std::string& mesh = meshes[point.mesh];
      if (mesh.empty()) mesh = print_of_mesh(point);
      print.add(mesh);
    }
    all.push_back({point.title, "evaluate", folder / "points" / print.text(), point.scene, job,
                   {sweep.limits.seconds + kSetUpTime, sweep.limits.memory}});
  }
  return all;
}

std::vector<Errand> distinct(const std::vector<Errand>& errands) {
  std::set<fs::path> seen;
  std::vector<Errand> out;
  for (const auto& errand : errands)
    if (!errand.command.empty() && seen.insert(errand.folder).second) out.push_back(errand);
  return out;
}

std::vector<Errand> slice(const std::vector<Errand>& errands, std::size_t part, std::size_t parts) {
  std::vector<Errand> out;
  for (std::size_t i = part - 1; i < errands.size(); i += parts) out.push_back(errands[i]);
  return out;
}

}  // namespace orthodyn
