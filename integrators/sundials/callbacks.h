// The border between SUNDIALS' C code and the model: no exception crosses it.
#pragma once

#include <exception>
#include <string>

#include "integrators/sundials/version.h"
#include "lib/core/errors.h"
#include "lib/ode/integrator.h"

namespace orthodyn::sundials {

// What callbacks share with their integrator.
struct Border {
  std::exception_ptr failure;     // a fatal exception on its way past the C code
  std::string recoverable_cause;  // why the last evaluation asked for a smaller step
  std::string message;    // what SUNDIALS said last
};

// Runs a callback's body: 0, +1 (recoverable: try a smaller step) or -1 (fatal).
template <class Body>
int guarded(Border& border, Body&& body) {
  try {
    body();
    return 0;
  } catch (const RecoverableError& e) {
    border.recoverable_cause = e.what();
    return 1;
  } catch (...) {
    border.failure = std::current_exception();
    return -1;
  }
}

inline void require_finite(const ConstVectorRef& f) {
  if (!f.allFinite()) throw RecoverableError("the force is not finite");
}

}  // namespace orthodyn::sundials
