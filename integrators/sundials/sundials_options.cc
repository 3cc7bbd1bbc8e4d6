#include "integrators/sundials/sundials_options.h"

#include "lib/core/versions.h"
#include "lib/linear/solver.h"

namespace orthodyn::sundials {

namespace {

const bool sundials_options_registered =
    solver_registry()
        .emplace("klu_full", SolverKind{"SUNDIALS' sparse matrix and KLU on the full 2n x 2n system: the textbook "
                                        "path, and the baseline; symmetric or not.",
                                        true, nullptr})
        .second;
const bool version_registered = library_versions().emplace("SUNDIALS", library_version()).second;

}  // namespace

Settings Settings::complete(const Options& options, const Task& task) {
  const Scales scales = options.scales(task);
  return {options, scales, true, options.linear_solver.type == "klu_full", scale_decisions(scales)};
}

Settings Settings::complete_explicit(const ErrorControl& control, const Task& task) {
  const Scales scales = control.scales(task);
  return {{control, {}, {}}, scales, false, false, scale_decisions(scales)};
}

void Settings::set_weights(N_Vector weights) const {
  positions(weights).setConstant(1 / (options.rtol * scales.position));
  velocities(weights).setConstant(1 / (options.rtol * scales.velocity));
}

}  // namespace orthodyn::sundials
