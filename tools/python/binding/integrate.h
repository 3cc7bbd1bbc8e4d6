// Integration of a Python model by any integrator of the library.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "tools/python/binding/python_model.h"

namespace orthodyn::python {

struct IntegrateRequest {
  std::string integrator;  // YAML: "{type: cvode_bdf, rtol: 1e-6}"
  State initial;
  std::vector<double> times;  // s, ascending, after the start; the last one ends the run
  double position_scale = 1, velocity_scale = 1;
};

// A dict with "t" (k,), "q" and "v" (k, n) at the start and at the times reached, "status", "message", "decisions" and
// "statistics". A failed run is a result, not an exception. Throws ConfigError for wrong options, and exceptions of the
// model's functions.
pybind11::dict integrate(const PythonModel& model, const IntegrateRequest& request);

}  // namespace orthodyn::python
