// Files with the derivatives of mode shapes.
#pragma once

#include <filesystem>

#include "lib/simulation/modes/modal_analysis.h"
#include "lib/simulation/sensitivity/shape_sensitivity.h"

namespace orthodyn {

// Adds the derivatives to the files of the shapes as fields "d shape / d PATH", scaled as the shape. If the scene has
// probes, writes shape_sensitivities.csv: a row per mode, with the shape of unit modal mass at each probe and its
// derivatives; NaN for a mode without derivatives. Throws RunError if a file cannot be written. Precondition:
// write_modes() has written the shapes.
void write_shape_sensitivities(const std::filesystem::path& folder, const Scene& scene, const ModalAnalysis& analysis,
                               const ShapeSensitivities& sensitivities);

}  // namespace orthodyn
