// Files of mode shapes: modes.csv, and modes.pvd for ParaView with a .vtu file for each shape.
#pragma once

#include <filesystem>
#include <vector>

#include "lib/simulation/modes/modal_analysis.h"

namespace orthodyn {

// Throws ConfigError if the folder contains other files than earlier modes, or if it contains earlier modes and
// `replace` is false.
void check_modes_folder(const std::filesystem::path& folder, bool replace);

// Writes the files, replacing earlier modes. Throws RunError.
void write_modes(const std::filesystem::path& folder, const ModalAnalysis& analysis);

// Writes modes.pvd and a .vtu file for each shape; the time of shape k in modes.pvd is k, starting at 1. Each .vtu file
// contains the shape, scaled to a largest displacement of 1, and the displacement of the state `about`. `shapes`:
// vectors of unknowns. Throws RunError.
void write_shapes(const std::filesystem::path& folder, const Model& model, const State& about,
                  const std::vector<Vector>& shapes);

}  // namespace orthodyn
