// Forces that integrators can go on with.
#pragma once

#include "lib/core/errors.h"
#include "lib/ode/model.h"

namespace orthodyn {

// Throws RecoverableError, on all ranks that hold the model, if an entry is no finite number on one of them.
// Collective.
inline void require_finite(const Model& model, const ConstVectorRef& f) {
  if (!model.space().is_finite(f)) throw RecoverableError("the force is not finite");
}

}  // namespace orthodyn
