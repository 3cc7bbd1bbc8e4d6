#include "lib/study/compare/reference_error.h"

#include <cmath>
#include <limits>

namespace orthodyn::study::compare {

bool is_exact(const Reference& reference) { return reference.result.kind == MeasurementResult::Kind::exact; }

std::optional<TrajectoryErrors> time_errors_of(const Reference* reference) {
  if (!reference || reference->folder.empty()) return std::nullopt;
  if (is_exact(*reference)) return reference->result.own_errors;
  return reference->check ? reference->check->errors : std::nullopt;
}

Reach::Reach(const Reference* reference, bool across_meshes) {
  if (across_meshes)
    mesh_error_ = reference ? reference->result.mesh_error.value_or(std::numeric_limits<double>::quiet_NaN()) : 0;
}

bool Reach::contains(double error, double time_error) const {
  return std::isfinite(error) && !(error >= of(time_error));
}

}  // namespace orthodyn::study::compare
