// The material axes of a scene as a file for ParaView.
#pragma once

#include <filesystem>

#include "lib/fem/fem_model.h"

namespace orthodyn {

// In each cell axis_1, axis_2, axis_3 in the rest shape, and its region. Throws RunError.
void write_axes(const std::filesystem::path& file, const FemModel& model);

}  // namespace orthodyn
