#include "lib/ode/integrator.h"

#include "lib/ode/internal_history.h"

namespace orthodyn {

std::unique_ptr<Integrator> IntegratorChoice::make(const Model& model, const Task& task) const {
  if (model.constraints()) {
    if (!solves_constraints())
      throw ConfigError(
          "this method is not available with joints or free rigid bodies, whose motion is a system with constraints; "
          "use ida_bdf, "
          "cvode_bdf, generalized_alpha, hht_alpha, newmark, central_differences or auto");
    if (task.sensitivities)
      throw ConfigError(
          "sensitivities of motions are not available with joints or free rigid bodies; remove one of them");
  }
  if (!model.internal_variables()) return make_for(model, task);
  if (task.sensitivities)
    throw ConfigError("sensitivities of motions are not available with viscoelastic materials; remove one of them");
  switch (internal_support()) {
    case InternalSupport::own: return make_for(model, task);
    case InternalSupport::fixed_steps:
      return std::make_unique<InternalHistory>(model, [&](const Model& own) { return make_for(own, task); });
    default:
      throw ConfigError(
          "this method is not available with viscoelastic materials; use cvode_bdf, ida_bdf, arkode_dirk, arkode_erk "
          "or auto, or a fixed step "
          "with newmark, hht_alpha, generalized_alpha, backward_euler, bathe, tr_bdf2 or semi_implicit_euler");
  }
}

}  // namespace orthodyn
