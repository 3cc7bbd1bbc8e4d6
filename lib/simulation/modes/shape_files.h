// Shapes of a body for ParaView: modes.pvd, whose times are their numbers from 1, and a file for each, with the shape
// and the displacement of the state that it is about.
#pragma once

#include <filesystem>
#include <vector>

#include "lib/ode/model.h"

namespace orthodyn {

// `shapes`: of the free coordinates; in the files the largest displacement is 1. Throws RunError.
void write_shapes(const std::filesystem::path& folder, const Model& model, const State& about,
                  const std::vector<Vector>& shapes);

}  // namespace orthodyn
