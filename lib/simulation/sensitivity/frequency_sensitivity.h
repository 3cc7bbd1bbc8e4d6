// Derivatives of natural frequencies with respect to numbers of the scene.
//
// For a mode of unit modal mass, d(omega^2)/dp = phi . (dK/dp - omega^2 dM/dp) phi, in which the change of the shape
// has no part (Nelson 1976, AIAA J. 14, 1201). For modes of equal frequency the derivatives are the eigenvalues of the
// matrix phi_i . (dK/dp - omega^2 dM/dp) phi_j, in ascending order.
//
// phi . K phi is twice the elastic energy of a small displacement along phi, a sum of positive terms, so that it has
// few rounding errors; the product K phi would lose as many digits as the largest frequency of the mesh exceeds that of
// the mode. Energies and masses of changed scenes are those of rebuilt models: every number that leaves the connections
// of the mesh as they are may be a parameter. Their derivatives are differences of fourth order in steps of 0.3 % (0.3
// degrees), or less if the scene does not allow such a step; no eigenproblem is solved.
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

// `scene`: the resolved input of the analysis, which must be about the rest shape. Throws ConfigError if a parameter
// changes the mesh's connections or the held coordinates.
std::vector<FrequencySensitivity> frequency_sensitivities(const Config& scene, const ModalAnalysis& analysis,
                                                          const std::vector<SceneParameter>& parameters);

// Writes sensitivities.csv: a row per mode, a column per parameter. Writes nothing if there are no sensitivities.
// Throws RunError if the file cannot be written.
void write_sensitivities(const std::filesystem::path& folder, const ModalAnalysis& analysis,
                         const std::vector<FrequencySensitivity>& sensitivities);

}  // namespace orthodyn
