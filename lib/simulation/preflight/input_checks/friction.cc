// Friction in analyses without velocities.

#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

void check_friction(const CheckContext& context, Warnings& out) {
  if (!context.is_static()) return;
  visit_keys(context.config, "friction", [&](const Config& friction) {
    if (friction.reads_as_number() && friction.number() > 0)
      warn(out, friction.where(),
           "friction acts against velocities: this analysis has none, and the surfaces slide without resistance. Use a "
           "motion with slowly rising loads and damping, or remove the key");
  });
}

}  // namespace orthodyn::input_checks
