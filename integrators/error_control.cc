#include "integrators/error_control.h"

namespace orthodyn {

Scales ErrorControl::scales(const Task& task) const {
  const bool given = position_scale && velocity_scale;
  const Scales estimated = given ? Scales{} : task.scales();
  return {position_scale.value_or(estimated.position), velocity_scale.value_or(estimated.velocity), estimated.omega};
}

void check_error_control(const ErrorControl& control, const Config& config) {
  if (control.h_max && control.h_min > *control.h_max) config.at("h_min").fail("is larger than h_max");
  if (control.h0 && control.h_max && *control.h0 > *control.h_max) config.at("h0").fail("is larger than h_max");
}

Decisions scale_decisions(const Scales& scales) {
  return {{"position_scale", number_text(scales.position)}, {"velocity_scale", number_text(scales.velocity)}};
}

}  // namespace orthodyn
