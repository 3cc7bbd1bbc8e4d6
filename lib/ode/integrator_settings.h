// What a program may ask an integrator's options for and change in them, whatever the method.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/value_schema.h"
#include "lib/core/solver_choice.h"

namespace orthodyn {

// A setting without a value is one that the method does not have, or that its options leave open.
struct IntegratorSettings {
  std::optional<double> rtol = {};                        // local error allowed per step, relative to the scales
  std::optional<double> step = {};                        // s: the fixed step
  std::optional<double> h0 = {}, h_min = {}, h_max = {};  // s: the first, smallest and largest step
  std::optional<double> position_scale = {}, velocity_scale = {};  // m, m/s
  std::optional<double> safety = {};                               // share of the critical step of an explicit method
  std::optional<int> modes = {};                                   // how many are kept
  std::optional<double> below = {};                                // Hz: the modes that are kept
  std::optional<long> max_steps = {};
  std::optional<SolverChoice> linear_solver = {};
};

// The numbers that are given, by their keys.
std::vector<std::pair<const char*, double>> numbers(const IntegratorSettings& settings);

// Throws ConfigError, with the key and without a place, for a number outside of the range of its key.
void check_ranges(const IntegratorSettings& settings, const std::vector<Key>& keys);

}  // namespace orthodyn
