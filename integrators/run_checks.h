// Checks and error messages shared by all integrators.
#pragma once

#include <string>

#include "lib/core/errors.h"
#include "lib/ode/model.h"

namespace orthodyn {

// Throws RecoverableError on all ranks if an entry of f on any rank is not finite. Collective.
inline void require_finite(const Model& model, const ConstVectorRef& f) {
  if (!model.space().is_finite(f)) throw RecoverableError("the force is not finite");
}

// Error for a run that reaches max_steps at time t (s). `name`: the integrator's type. `key`: the key that reduces the
// number of steps if raised; may be empty.
RunError too_many_steps_error(const std::string& name, double t, long steps, const std::string& key);

// Error for a force that cannot be evaluated at the start because of `cause`.
RunError initial_force_error(const std::string& name, double t, const std::string& cause);

}  // namespace orthodyn
