// `orthodyn check --axes`: the material axes of a scene, to be looked at.
#pragma once

#include <filesystem>

#include "lib/simulation/setup.h"

namespace orthodyn {

// Writes axes.vtu (in each cell axis_1, axis_2, axis_3 in the rest shape, and region) into the folder, has
// axes.png drawn from it, and says where they are; a warning if there is no picture. Throws RunError.
void write_axes(const Setup& setup, const std::filesystem::path& folder);

// "cylindrical, per element", for each region of the mesh by its name.
void print_axes(const Setup& setup);

}  // namespace orthodyn
