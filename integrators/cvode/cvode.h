// CVODE's linear multistep methods (Hindmarsh et al. 2005): BDF and Adams-Moulton.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "integrators/sundials/sundials_options.h"

namespace orthodyn::sundials {

struct CvodeMethod {
  std::string name;  // the integrator's type, for messages
  int family;        // CV_BDF or CV_ADAMS
  int max_order;
  // Number of earlier iterates that accelerate the fixed-point iteration; empty for Newton's method.
  std::optional<int> anderson = {};
};

// Throws ConfigError if the linear solver does not accept the model's matrices. `model` must outlive the integrator.
std::unique_ptr<Integrator> make_cvode(const CvodeMethod& method, const Model& model, const Options& options,
                                       const Scales& scales);

}  // namespace orthodyn::sundials
