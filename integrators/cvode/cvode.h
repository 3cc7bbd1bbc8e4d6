// CVODE's linear multistep methods (Hindmarsh et al. 2005): BDF and Adams-Moulton. The library is CVODES, which is
// CVODE with forward sensitivities (Serban & Hindmarsh 2005).
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "integrators/sundials/sundials_options.h"
#include "lib/ode/adjoint_equations.h"

namespace orthodyn::sundials {

struct CvodeMethod {
  std::string name;  // the integrator's type, for messages
  int family;        // CV_BDF or CV_ADAMS
  int max_order;
  // Number of earlier iterates that accelerate the fixed-point iteration; empty for Newton's method.
  std::optional<int> anderson = {};
  bool simultaneous = false;  // see SensitivityCorrector
};

// Throws ConfigError if the linear solver does not accept the model's matrices. `model` and `sensitivities`, which may
// be null, must outlive the integrator.
std::unique_ptr<Integrator> make_cvode(const CvodeMethod& method, const Model& model, const Options& options,
                                       const Scales& scales, SensitivityEquations* sensitivities);

// AdjointIntegrator::integrate_adjoint() with this method for the motion, and BDF for the adjoint equations.
AdjointSolution integrate_cvode_adjoint(const CvodeMethod& method, const Model& model, const Options& options,
                                        const Scales& scales, const Task& task, AdjointEquations& equations);

}  // namespace orthodyn::sundials
