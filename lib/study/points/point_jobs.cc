#include "lib/study/points/point_jobs.h"

#include <fmt/format.h>

#include <utility>

namespace orthodyn::study {

PointScene point_scene(const Config& scene, const std::string& title) {
  return {title, scene.dump_for(""), scene.at("mesh").yaml(), scene.file_paths()};
}

PointJobs::PointJobs(const EvaluationInput& input, const Limits& limits, std::filesystem::path folder, int ranks)
    : input_(to_json(input)), limits_(limits), folder_(std::move(folder)), ranks_(ranks) {}

Job PointJobs::job(const PointScene& point) {
  Fingerprint hash;
  hash.add(point.scene).add(input_.dump()).add(fmt::format("{}", limits_.memory));
  if (ranks_ > 1) hash.add(fmt::format("{} ranks", ranks_));
  for (const auto& file : point.files) hash.add(files_.of(file));
  if (!point.files.empty()) {
    std::string& mesh = meshes_[point.mesh];
    if (mesh.empty()) mesh = mesh_hash(Config::from_text(point.scene));
    hash.add(mesh);
  }
  return {point.title, "evaluate", folder_ / "points" / hash.text(),
          point.scene, input_,     {limits_.seconds + kSetUpSeconds, limits_.memory}};
}

}  // namespace orthodyn::study
