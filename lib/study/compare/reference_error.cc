#include "lib/study/compare/reference_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace orthodyn::study::compare {

bool is_exact(const Reference& reference) { return reference.result.kind == MeasurementResult::Kind::exact; }

std::optional<TrajectoryErrors> time_errors_of(const Reference* reference) {
  if (!reference || reference->folder.empty()) return std::nullopt;
  if (is_exact(*reference)) return reference->result.own_errors;
  return reference->check ? reference->check->errors : std::nullopt;
}

namespace {

// Number of periods of the dominant frequency in the integration time; 0 if there is no such frequency.
double periods_of(const MeasurementResult& result) {
  if (!result.model || !result.scales || !std::isfinite(result.scales->dominant_frequency)) return 0;
  return result.scales->dominant_frequency * (result.model->end - result.model->start);
}

}  // namespace

ReferenceFloor::ReferenceFloor(const Reference* reference, bool across_meshes) {
  if (!across_meshes || !reference) return;
  const MeasurementResult& result = reference->result;
  mesh_error_ = result.mesh_error.value_or(std::numeric_limits<double>::quiet_NaN()) *
                std::max(1.0, std::numbers::pi * periods_of(result));
}

bool ReferenceFloor::covers(double error, double time_error) const {
  return std::isfinite(error) && !(error >= at(time_error));
}

}  // namespace orthodyn::study::compare
