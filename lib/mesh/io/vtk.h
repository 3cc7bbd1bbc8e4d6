// Meshes of solid cells in VTK's legacy files of unstructured grids (.vtk), ASCII or binary, with cells as up
// to version 4.2 or as from 5.0. They are only read.
//
// Format: Kitware, VTK file formats, "simple legacy formats".
#pragma once

#include <string>
#include <string_view>

#include "lib/mesh/io/mesh_format.h"

namespace orthodyn {

// What becomes of cells and arrays: see build_vtk_mesh(). Throws ConfigError "file:line: found,
// remedy". Memory use is bounded by the size of the file, whatever counts it announces.
LoadedMesh read_vtk(const std::string& path);

// The same from a text; `path` is for messages.
LoadedMesh read_vtk_text(const std::string& path, std::string_view text);

}  // namespace orthodyn
