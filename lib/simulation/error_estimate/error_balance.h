// Which error of a run is the larger one, that of the mesh or that of the integration, and what to change.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/run/run_result.h"

namespace orthodyn {

struct ErrorBalance {
  double mesh = 0;             // MeshError::relative
  std::string mesh_by;         // "finer elements, 0.2 s of CPU"
  std::optional<double> time;  // of the motion: estimated, or as far as errors of steps have added up; else unknown
  std::vector<ProbedError> probed;  // MeshError::probed
  bool probed_unknown = false;      // MeshError::probed_unknown
  std::string advice;               // "the mesh dominates: use finer cells; rtol 1e-3 would do"
};

// None where the mesh's error is not known.
std::optional<ErrorBalance> error_balance(const RunResult& result);

}  // namespace orthodyn
