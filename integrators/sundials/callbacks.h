// Guards callbacks from SUNDIALS' C code into the model, so that no exception passes through C code.
#pragma once

#include <exception>
#include <string>

#include "integrators/sundials/version.h"
#include "lib/core/cause.h"
#include "lib/core/errors.h"
#include "lib/ode/integrator.h"

namespace orthodyn::sundials {

// State shared by an integrator and its callbacks.
struct CallbackContext {
  std::exception_ptr failure;  // a fatal exception, rethrown after the C code has returned
  Cause recoverable_cause;     // the last RecoverableError
  std::string message;         // SUNDIALS' last error message
};

// Runs a callback's body. Returns 0, +1 (recoverable: try a smaller step) or -1 (fatal).
template <class Body>
int guarded(CallbackContext& context, Body&& body) {
  try {
    body();
    return 0;
  } catch (const RecoverableError& e) {
    try {
      context.recoverable_cause.note(e);
    } catch (...) {  // no memory for the text
      context.recoverable_cause.clear();
    }
    return 1;
  } catch (...) {
    context.failure = std::current_exception();
    return -1;
  }
}

}  // namespace orthodyn::sundials
