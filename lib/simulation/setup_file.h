// Where a body is held and loaded, as a file for ParaView and `orthodyn view`.
#pragma once

#include <filesystem>

#include "lib/simulation/setup.h"

namespace orthodyn {

inline constexpr const char* kSetupFile = "setup.vtu";

// The rest shape with, at each node, `held`: 1 for each coordinate that is clamped or moved, else 0; and `load`, N: what
// loads other than gravity exert in the initial state at the peak of their factors. Springs, dashpots and contact are no
// loads. Throws RunError.
void write_setup(const std::filesystem::path& file, const Setup& setup);

}  // namespace orthodyn
