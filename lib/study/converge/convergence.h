// A convergence study: one scene on successively refined meshes of linear and of quadratic elements.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/study/inputs/limits.h"
#include "lib/study/points/point_jobs.h"
#include "lib/study/quantities/wanted_metric.h"

namespace orthodyn::study::converge {

inline constexpr int kRatio = 2;  // ratio of the cell sizes of consecutive levels

struct Convergence {
  std::string file;              // the scene file
  std::vector<std::string> set;  // changes of the scene: "mesh.cells=[8,2,1]"
  int levels = 3;                // number of meshes per element order; the first is the scene's own mesh
  std::vector<int> orders{1, 2};
  // "tip.displacement.z" or "max of tip.displacement.z". If empty and `modes` is 0: the scene's expectations, otherwise
  // the displacements of its probes, otherwise its elastic energy.
  std::vector<std::string> quantities;
  int modes = 0;  // number of natural frequencies, from the lowest
  Limits limits{.seconds = 600};
  int ranks = 1;  // processes per mesh
};

// One mesh of the study.
struct Level {
  int order = 1, level = 0;  // of the elements; number of refinements
  PointScene scene;
};

struct Design {
  Named<WantedMetric> metrics;
  std::vector<Level> levels;  // ordered by element order, then from coarse to fine
};

// Looks up the metrics and makes one scene per mesh: with `mesh.cells` times 2^level, or for a mesh from a file with
// `mesh.refine` + level. Throws ConfigError.
Design design_of(const Convergence& wanted);

EvaluationInput input_of(const Convergence& wanted, const Design& design);

}  // namespace orthodyn::study::converge
