// The files of a modal analysis: modes.csv, and the shapes for ParaView as modes.pvd with a file for each.
#pragma once

#include <filesystem>

#include "lib/simulation/modes/modal_analysis.h"

namespace orthodyn {

// Throws ConfigError for a folder with anything in it, other than earlier modes that are to be replaced.
void check_modes_folder(const std::filesystem::path& folder, bool replace);

// Replaces earlier modes. Throws RunError.
void write_modes(const std::filesystem::path& folder, const ModalAnalysis& analysis);

}  // namespace orthodyn
