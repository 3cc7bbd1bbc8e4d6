// Callbacks from SUNDIALS' C code into the model: no exception passes through C.
#pragma once

#include <exception>
#include <string>

#include "integrators/sundials/version.h"
#include "lib/core/errors.h"
#include "lib/ode/integrator.h"

namespace orthodyn::sundials {

// What callbacks share with their integrator.
struct CallbackContext {
  std::exception_ptr failure;     // a fatal exception on its way past the C code
  std::string recoverable_cause;  // why the last evaluation asked for a smaller step
  std::string message;            // what SUNDIALS said last
};

// Runs a callback's body: 0, +1 (recoverable: try a smaller step) or -1 (fatal).
template <class Body>
int guarded(CallbackContext& context, Body&& body) {
  try {
    body();
    return 0;
  } catch (const RecoverableError& e) {
    try {
      context.recoverable_cause = e.what();
    } catch (...) {  // no memory for the words
      context.recoverable_cause.clear();
    }
    return 1;
  } catch (...) {
    context.failure = std::current_exception();
    return -1;
  }
}

}  // namespace orthodyn::sundials
