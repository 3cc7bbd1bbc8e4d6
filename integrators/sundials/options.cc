#include "integrators/sundials/options.h"

#include <fmt/format.h>

#include "lib/core/versions.h"
#include "lib/linear/solver.h"

namespace orthodyn::sundials {

namespace {

const bool registered =
    solver_registry()
        .emplace("klu_full", SolverKind{"SUNDIALS' sparse matrix and KLU on the full 2n x 2n system: the textbook "
                                        "path, and the baseline; symmetric or not.",
                                        true, nullptr})
        .second;
const bool version_registered = library_versions().emplace("SUNDIALS", library_version()).second;

}  // namespace

std::vector<std::string> linear_solver_names() {
  std::vector<std::string> names;
  for (const auto& [name, kind] : solver_registry()) names.push_back(name);
  return names;
}

void check_options(const Options& options, const Config& config) {
  if (options.h_max && options.h_min > *options.h_max) config.at("h_min").fail("is larger than h_max");
  if (options.h0 && options.h_max && *options.h0 > *options.h_max) config.at("h0").fail("is larger than h_max");
  if (solver_registry().contains(options.linear_solver)) return;
  const auto names = linear_solver_names();
  const auto near = nearest_name(options.linear_solver, names);
  config.at("linear_solver")
      .fail("expected one of " + join(names) + ", found '" + options.linear_solver + "'" +
            (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

Settings Settings::complete(const Options& options, const Task& task) {
  const bool given = options.position_scale && options.velocity_scale;
  const Scales estimated = given ? Scales{} : task.scales();
  const Scales scales = {options.position_scale.value_or(estimated.position),
                         options.velocity_scale.value_or(estimated.velocity)};
  return {options,
          scales,
          options.linear_solver == "klu_full",
          {{"position_scale", number_text(scales.position)}, {"velocity_scale", number_text(scales.velocity)}}};
}

void Settings::set_weights(N_Vector weights) const {
  positions(weights).setConstant(1 / (options.rtol * scales.position));
  velocities(weights).setConstant(1 / (options.rtol * scales.velocity));
}

}  // namespace orthodyn::sundials
