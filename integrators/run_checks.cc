#include "integrators/run_checks.h"

#include <fmt/format.h>

namespace orthodyn {

RunError too_many_steps_error(const std::string& name, double t, long steps, const std::string& key) {
  return RunError(fmt::format("{} gave up at t = {:.6g} s after {} steps (max_steps); raise integrator.max_steps{}",
                              name, t, steps, key.empty() ? "" : " or " + key),
                  Reason::too_many_steps);
}

RunError initial_force_error(const std::string& name, double t, const std::string& cause) {
  return RunError(
      fmt::format(
          "{} stopped at t = {:.6g} s: the force cannot be evaluated ({}); check the initial state and the loads", name,
          t, cause),
      Reason::force);
}

}  // namespace orthodyn
