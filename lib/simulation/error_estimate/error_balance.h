// Compares the errors of the mesh and of the time integration, and advises what to refine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/simulation/run/run_result.h"

namespace orthodyn {

struct ErrorBalance {
  double mesh = 0;                  // MeshError::relative
  std::string mesh_by;              // source of the mesh error: "finer elements, 0.2 s of CPU"
  std::optional<double> time;       // relative error of the integration, if estimated
  std::vector<ProbedError> probed;  // MeshError::probed
  bool probed_unknown = false;      // MeshError::probed_unknown
  std::string advice;               // "the mesh dominates: use finer cells; rtol 1e-3 would suffice"
};

// Empty if the mesh error is unknown.
std::optional<ErrorBalance> error_balance(const RunResult& result);

}  // namespace orthodyn
