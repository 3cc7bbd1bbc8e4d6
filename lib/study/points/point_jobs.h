// Jobs that evaluate scenes: each in a folder whose name tells what the result depends on: the scene, the files that it
// names, the metrics, the limits, the program, the number of ranks. Not the machine: points may come from several.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "lib/simulation/run/fingerprints.h"
#include "lib/study/inputs/limits.h"
#include "lib/study/jobs/job.h"
#include "lib/study/points/evaluation.h"

namespace orthodyn::study {

// A scene as it will be computed.
struct PointScene {
  std::string title;               // "angle 30 deg, mesh fine"
  std::string scene;               // in YAML, for a reader anywhere
  std::string mesh;                // its section, with what it names
  std::vector<std::string> files;  // that it names
};

// Of a resolving() Config that has been read as a scene.
PointScene point_scene(const Config& scene, const std::string& title);

class PointJobs {
 public:
  // In FOLDER/points. `ranks`: that compute each.
  PointJobs(const EvaluationInput& input, const Limits& limits, std::filesystem::path folder, int ranks);

  // Throws RunError if a file of the scene cannot be read.
  Job job(const PointScene& point);

 private:
  Json input_;
  Limits limits_;
  std::filesystem::path folder_;
  int ranks_;
  std::map<std::string, std::string> meshes_;  // fingerprints by section
  FileFingerprints files_;
};

}  // namespace orthodyn::study
