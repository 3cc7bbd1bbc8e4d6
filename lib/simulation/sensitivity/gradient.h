// The derivatives of one displacement, velocity or strain with respect to many numbers of a scene, by adjoint
// equations: the cost hardly depends on the number of parameters. Forward sensitivities (motion_sensitivity.h) give the
// derivatives of many quantities with respect to few numbers.
//
// Motions: lib/ode/adjoint_equations.h. Equilibria: with K^T l = dQ/dq, dQ/dp = l . df/dp.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/config/config.h"
#include "lib/simulation/sensitivity/scene_parameter.h"

namespace orthodyn {

// What is computed, and how far it is.
struct GradientProgress {
  enum class Stage { equilibrium, motion, adjoint } stage;
  double at;     // load factor of an equilibrium, or time, s
  double share;  // of the stage that is done, 0 to 1
};

struct GradientRequest {
  std::string quantity;           // "PROBE.displacement.z", "PROBE.velocity.z" or "GAUGE.strain"
  std::optional<double> at = {};  // time of a motion, s; default its end
  // Paths of numbers. The path of a region's `stiffness_factors` stands for the factors of all cells of its grid.
  std::vector<std::string> paths = {};
  std::function<void(const GradientProgress&)> on_progress = {};  // may be empty; called often
};

struct Gradient {
  double value = 0;  // of the quantity, SI
  std::string unit;  // of the quantity, SI
  std::vector<SceneParameter> parameters;
  std::vector<double> derivatives;  // per SI unit of each parameter
  // Numbers of the cell along x, y and z, from 1, of each stiffness factor; zeros for other parameters.
  std::vector<std::array<int, 3>> cells;
  std::optional<double> rtol = {};             // of a motion
  double adjoint_rtol = 0;                     // of the adjoint equations; 0 for an equilibrium
  long forward_steps = 0, backward_steps = 0;  // 0 for an equilibrium
};

// `config`: resolved input of a static or dynamic scene. Throws ConfigError for a quantity or a parameter without
// derivatives by adjoint equations, with the reason; RunError if the motion or the equilibrium fails.
Gradient gradient(const Config& config, const GradientRequest& request);

}  // namespace orthodyn
