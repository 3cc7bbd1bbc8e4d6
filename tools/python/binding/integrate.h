// Any integrator of the library on a model that is written in Python.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "tools/python/binding/python_model.h"

namespace orthodyn::python {

struct IntegrateRequest {
  std::string integrator;  // its options, YAML: "{type: cvode_bdf, rtol: 1e-6}"
  State initial;
  std::vector<double> times;  // s, ascending, after the start; the last is the end
  double position_scale = 1, velocity_scale = 1;
};

// "t" (k,), "q" and "v" (k, n) at the start and at the times that were reached, "status", "message",
// "decisions" and "statistics". A computation that could not go on is a result. Throws ConfigError for options, and
// what the model throws in Python.
pybind11::dict integrate(const PythonModel& model, const IntegrateRequest& request);

}  // namespace orthodyn::python
