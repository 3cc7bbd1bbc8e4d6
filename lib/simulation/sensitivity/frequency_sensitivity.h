// Derivatives of natural frequencies with respect to numbers of the scene.
//
// For a mode of unit modal mass, d(omega^2)/dp = phi . (dK/dp - omega^2 dM/dp) phi, in which the change of the shape
// has no part (Nelson 1976, AIAA J. 14, 1201). For modes of equal frequency the derivatives are the eigenvalues of the
// matrix phi_i . (dK/dp - omega^2 dM/dp) phi_j, in ascending order.
//
// phi . K phi is computed as twice the elastic energy of a small displacement along phi. The energy is a sum of
// positive terms and has few rounding errors. The product K phi would be less accurate: its relative error is about
// machine epsilon times (f_max / f)^2, with the highest frequency f_max of the mesh and the frequency f of the mode.
//
// dK/dp and dM/dp are differences between changed models (changed_models.h). No eigenproblem of a changed scene is
// solved.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/simulation/modes/modal_analysis.h"
#include "lib/simulation/sensitivity/scene_parameter.h"

namespace orthodyn {

struct FrequencySensitivity {
  SceneParameter parameter;
  // One per mode, Hz per SI unit of the parameter; NaN for modes of zero frequency and for unstable modes.
  std::vector<double> derivatives;
};

// The parameters at these paths. Throws ConfigError if a path is no parameter (scene_parameter.h), or if the scene does
// not allow it to change.
std::vector<SceneParameter> scene_parameters(const Config& scene, const std::vector<std::string>& paths);

// `scene`: the resolved input of `model`; `rest`: its rest shape, about which the modes are. Throws ConfigError if a
// parameter changes the mesh's connections or the held coordinates.
std::vector<FrequencySensitivity> frequency_sensitivities(const Config& scene, const FemModel& model, const State& rest,
                                                          const Modes& modes,
                                                          const std::vector<SceneParameter>& parameters);
// Likewise. Precondition: the analysis is about the rest shape.
std::vector<FrequencySensitivity> frequency_sensitivities(const Config& scene, const ModalAnalysis& analysis,
                                                          const std::vector<SceneParameter>& parameters);

// Writes sensitivities.csv: a row per mode, a column per parameter. Writes nothing if there are no sensitivities.
// Throws RunError if the file cannot be written.
void write_sensitivities(const std::filesystem::path& folder, const ModalAnalysis& analysis,
                         const std::vector<FrequencySensitivity>& sensitivities);

}  // namespace orthodyn
