// Jobs that evaluate scenes. A job's folder is named by the fingerprint of everything that affects its result: scene,
// files, metrics, limits, program and number of ranks. The machine is left out: points may be computed on several
// machines.
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

// A scene with all defaults filled in.
struct PointScene {
  std::string title;               // "angle 30 deg, mesh fine"
  std::string scene;               // YAML with absolute paths, so that it can be read in any folder
  std::string mesh;                // the section `mesh`
  std::vector<std::string> files;  // that the scene uses
};

// Precondition: `scene` is from Config::resolving(), and read_scene() has filled in its defaults.
PointScene point_scene(const Config& scene, const std::string& title);

class PointJobs {
 public:
  // Job folders are in `folder`/points. `ranks`: MPI ranks per point.
  PointJobs(const EvaluationInput& input, const Limits& limits, std::filesystem::path folder, int ranks);

  // Throws RunError if a file of the scene cannot be read.
  Job job(const PointScene& point);

 private:
  Json input_;
  Limits limits_;
  std::filesystem::path folder_;
  int ranks_;
  std::map<std::string, std::string> meshes_;  // fingerprints by the section `mesh`
  FileFingerprints files_;
};

}  // namespace orthodyn::study
