// ARKODE's Runge-Kutta methods (Reynolds et al. 2023): explicit, diagonally implicit or additive, with adaptive or
// fixed steps. An additive method splits the force, f = f_explicit + f_implicit:
//
//   d(q, v)/dt = (0, M^-1 f_explicit) + (v, M^-1 f_implicit)
//
// An adaptive step in which the force cannot be evaluated is restarted with a quarter of its length. Dense output is
// the quintic Hermite polynomial through q, v and a at both ends of the step (hermite.h).
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "integrators/arkode/tableau.h"
#include "integrators/sundials/sundials_options.h"

namespace orthodyn::sundials {

// A model's force as the sum of two models' forces.
struct SplitForce {
  std::unique_ptr<Model> explicit_part, implicit_part;
};

struct ArkMethod {
  std::string name;            // the integrator's type, for messages
  std::optional<double> step;  // fixed step (s); empty for adaptive steps
  // The last stage of each table is the end of the step (tableau.h). Null if the method has no such part.
  Tableau explicit_table = {}, implicit_table = {};
  // True if Newton's method solves the last implicit stage; false if with_end_stage() has added an explicit last stage.
  bool stiffly_accurate = false;
  SplitForce split = {};  // set only if both tables are
};

// Throws ConfigError if the linear solver does not accept the model's matrices. `model` must outlive the integrator. An
// explicit method uses only the error control of `options`.
std::unique_ptr<Integrator> make_ark_step(const Model& model, ArkMethod method, const Options& options,
                                          const Scales& scales);

}  // namespace orthodyn::sundials
