// A scene on meshes that are refined step by step, of linear and of quadratic elements: what is asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/study/inputs/limits.h"
#include "lib/study/points/point_jobs.h"
#include "lib/study/quantities/wanted_metric.h"

namespace orthodyn::study::converge {

inline constexpr int kRatio = 2;  // of the sizes of cells on neighbouring levels

struct Convergence {
  std::string file;              // the scene's
  std::vector<std::string> set;  // PATH=VALUE
  int levels = 3;                // the first is the scene's own mesh
  std::vector<int> orders{1, 2};
  std::vector<std::string>
      quantities;  // "tip.displacement.z" or "max of tip.displacement.z"; none: chosen by the scene
  int modes = 0;   // the lowest natural frequencies as well
  Limits limits{.seconds = 600};
  int ranks = 1;  // that compute a mesh
};

// One mesh.
struct Level {
  int order = 1, level = 0;
  PointScene scene;
};

struct Design {
  Named<WantedMetric> metrics;
  std::vector<Level> levels;  // by order, from coarse to fine
};

// Reads the scene and makes one for each mesh: `mesh.cells` times 2^level, or `mesh.refine` of meshes from files.
// Throws ConfigError.
Design design_of(const Convergence& wanted);

EvaluationInput input_of(const Convergence& wanted, const Design& design);

}  // namespace orthodyn::study::converge
