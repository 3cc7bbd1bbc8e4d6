// Derivatives of mode shapes with respect to numbers of the scene, by Nelson's method.
//
// The derivative of a shape of unit modal mass is phi' = z + c phi (Nelson 1976, AIAA J. 14, 1201), with
//
//     (K - lambda M) z = -(K' - lambda' M - lambda M') phi,   c = -phi . M z - phi . M' phi / 2.
//
// K - lambda M is singular: its null space is phi. z is the solution that is 0 at the coordinate where phi is largest,
// and c keeps the modal mass at 1. Only the mode itself is needed, and one factor per mode for all parameters. K' phi
// and M' phi are differences between changed models (changed_models.h). No eigenproblem of a changed scene is solved.
//
// Shapes of modes of equal frequency, and of modes of 0 Hz, are not unique and have no derivative.
#pragma once

#include <string>
#include <vector>

#include "lib/analysis/modes.h"
#include "lib/fem/fem_model.h"
#include "lib/simulation/sensitivity/scene_parameter.h"

namespace orthodyn {

struct ShapeSensitivity {
  SceneParameter parameter;
  // One per mode: derivative of the free coordinates of the shape of unit modal mass, per SI unit of the parameter;
  // empty for a mode without one.
  std::vector<Vector> derivatives;
};

struct ShapeSensitivities {
  std::vector<ShapeSensitivity> by_parameter;
  // One entry per mode: "" if its derivative was computed, else the reason why not, such as "its frequency equals that
  // of mode 8".
  std::vector<std::string> missing;
};

// `scene`: the resolved input of `model`; `rest`: its rest shape, about which the modes are. Throws ConfigError if a
// parameter changes the mesh's connections or the held coordinates; RunError if a linear system cannot be solved.
ShapeSensitivities shape_sensitivities(const Config& scene, const FemModel& model, const State& rest,
                                       const Modes& modes, const std::vector<SceneParameter>& parameters);

}  // namespace orthodyn
