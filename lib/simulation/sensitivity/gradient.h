// The derivatives of one displacement, velocity or strain with respect to many numbers of a scene, by adjoint
// equations: the cost hardly depends on the number of parameters. Forward sensitivities (motion_sensitivity.h) give the
// derivatives of many quantities with respect to few numbers.
//
// Motions: lib/ode/adjoint_equations.h. Equilibria: with K^T l = dQ/dq, dQ/dp = l . df/dp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/config.h"
#include "lib/simulation/sensitivity/scene_parameter.h"

namespace orthodyn {

struct GradientRequest {
  std::string quantity;           // "PROBE.displacement.z", "PROBE.velocity.z" or "GAUGE.strain"
  std::optional<double> at = {};  // time of a motion, s; default its end
  // Paths of numbers. The path of a region's `stiffness_factors` stands for the factors of all cells of its grid.
  std::vector<std::string> paths = {};
};

struct Gradient {
  double value = 0;  // of the quantity, SI
  std::string unit;  // of the quantity, SI
  std::vector<SceneParameter> parameters;
  std::vector<double> derivatives;             // per SI unit of each parameter
  long forward_steps = 0, backward_steps = 0;  // 0 for an equilibrium
};

// `config`: resolved input of a static or dynamic scene. Throws ConfigError for a quantity or a parameter without
// derivatives by adjoint equations, with the reason; RunError if the motion or the equilibrium fails.
Gradient gradient(const Config& config, const GradientRequest& request);

}  // namespace orthodyn
