// Files of a modal analysis: modes.csv with one row per mode, and modes.pvd for ParaView with one .vtu file per shape.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/simulation/modes/modal_analysis.h"

namespace orthodyn {

// Throws ConfigError if the folder has files but no modes.csv, if it has modes.csv and `replace` is false, or if it is
// a file.
void check_modes_folder(const std::filesystem::path& folder, bool replace);

// Writes all files, after removing earlier ones. Throws RunError if a file cannot be removed or written.
void write_modes(const std::filesystem::path& folder, const ModalAnalysis& analysis);

// A further vector field of the nodes in the file of a shape, such as a derivative of the shape.
struct ShapeField {
  std::string name;
  Vector values;  // one per unknown
};

// Writes modes.pvd and a .vtu file for each shape; the time of shape k in modes.pvd is k, starting at 1. Each .vtu file
// contains the shape, scaled to a largest displacement of 1, the displacement of the state `about`, and the fields of
// this shape in `more` (one list per shape, or empty), scaled as the shape. `shapes`: vectors of unknowns, each with a
// nonzero displacement. Throws RunError if a file cannot be written.
void write_shapes(const std::filesystem::path& folder, const Model& model, const State& about,
                  const std::vector<Vector>& shapes, const std::vector<std::vector<ShapeField>>& more = {});

}  // namespace orthodyn
