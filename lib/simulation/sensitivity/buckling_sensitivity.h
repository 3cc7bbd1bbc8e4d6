// Derivatives of critical load factors of linear buckling with respect to numbers of the scene.
//
// For a mode with K phi = -lambda K_g phi and phi . K phi = 1,
//
//     d lambda/dp = lambda phi . (dK/dp + lambda dK_g/dp) phi,
//
// in which the change of the shape has no part. dK_g/dp includes the change of the prebuckling state u(p), with
// K du/dp = df/dp - dK/dp u, and the change of the shape without loads. All parameters share one factor of K. For modes
// of equal load factor the derivatives are the eigenvalues of lambda phi_i . (dK/dp + lambda dK_g/dp) phi_j, in
// ascending order (the formulas of Nelson 1976, AIAA J. 14, 1201, with M replaced by -K_g).
//
// The derivatives of the matrices are differences between changed models (changed_models.h). No eigenproblem and no
// prebuckling state of a changed scene is solved.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/analysis/buckling.h"
#include "lib/simulation/sensitivity/scene_parameter.h"

namespace orthodyn {

struct BucklingSensitivity {
  SceneParameter parameter;
  std::vector<double> derivatives;  // one per mode, per SI unit of the parameter
};

// `scene`: resolved input of `model`. `modes`: computed for `unloaded` and the loads at time t (s). Throws ConfigError
// if a parameter changes the mesh's connections or the held coordinates, and for contact, which has kinks; RunError as
// buckling_modes().
std::vector<BucklingSensitivity> buckling_sensitivities(const Config& scene, const FemModel& model,
                                                        const Vector& unloaded, double t, const BucklingModes& modes,
                                                        const std::vector<SceneParameter>& parameters);

// Writes sensitivities.csv: a row per mode, a column per parameter. Writes nothing if there are no sensitivities.
// Throws RunError if the file cannot be written.
void write_sensitivities(const std::filesystem::path& folder, const BucklingModes& modes,
                         const std::vector<BucklingSensitivity>& sensitivities);

}  // namespace orthodyn
