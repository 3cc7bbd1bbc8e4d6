// Options that integrators have in common, which a program may read and change without knowing the method.
#pragma once

#include <optional>
#include <vector>

#include "lib/config/value_schema.h"
#include "lib/core/solver_choice.h"

namespace orthodyn {

// A setting has no value if the method lacks it or its options leave it open.
struct IntegratorSettings {
  std::optional<double> rtol = {};                                 // local error per step, relative to the scales
  std::optional<double> step = {};                                 // fixed step, s
  std::optional<double> h0 = {}, h_min = {}, h_max = {};           // first, smallest and largest step, s
  std::optional<double> position_scale = {}, velocity_scale = {};  // m, m/s
  std::optional<double> safety = {};                               // step of an explicit method / critical step
  std::optional<int> modes = {};                                   // number of modes kept
  std::optional<double> below = {};                                // modes below this frequency are kept, Hz
  std::optional<long> max_steps = {};
  std::optional<SolverChoice> linear_solver = {};
};

// Calls visit("rtol", options.rtol, settings.rtol) and so on, for every setting for which the options have a member.
template <class Options, class Settings, class Visit>
void for_each_setting(Options& options, Settings& settings, Visit visit) {
  if constexpr (requires { options.step; }) visit("step", options.step, settings.step);
  if constexpr (requires { options.safety; }) visit("safety", options.safety, settings.safety);
  if constexpr (requires { options.rtol; }) visit("rtol", options.rtol, settings.rtol);
  if constexpr (requires { options.modes; }) visit("modes", options.modes, settings.modes);
  if constexpr (requires { options.below; }) visit("below", options.below, settings.below);
  if constexpr (requires { options.h_max; }) visit("h_max", options.h_max, settings.h_max);
  if constexpr (requires { options.h_min; }) visit("h_min", options.h_min, settings.h_min);
  if constexpr (requires { options.h0; }) visit("h0", options.h0, settings.h0);
  if constexpr (requires { options.position_scale; })
    visit("position_scale", options.position_scale, settings.position_scale);
  if constexpr (requires { options.velocity_scale; })
    visit("velocity_scale", options.velocity_scale, settings.velocity_scale);
  if constexpr (requires { options.max_steps; }) visit("max_steps", options.max_steps, settings.max_steps);
  if constexpr (requires { options.linear_solver; })
    visit("linear_solver", options.linear_solver, settings.linear_solver);
}

// Keys and values of the numeric settings that have a value.
std::vector<std::pair<const char*, double>> numeric_settings(const IntegratorSettings& settings);

// Throws ConfigError, with the key but without file and line, for a number outside its key's range.
void check_ranges(const IntegratorSettings& settings, const std::vector<Key>& keys);

}  // namespace orthodyn
