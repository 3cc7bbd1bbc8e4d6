// Reads legacy VTK files of unstructured grids (.vtk): ASCII or binary, cells in the form of versions up to 4.2 or from
// 5.0.
//
// Format: Kitware, VTK file formats, "simple legacy formats".
#pragma once

#include <string>
#include <string_view>

#include "lib/mesh/io/mesh_format.h"

namespace orthodyn {

// build_vtk_mesh() describes the result. Throws ConfigError "file:line: found, remedy". Memory use is bounded by the
// file size, whatever counts the file announces.
LoadedMesh read_vtk(const std::string& path, FileCells cells = FileCells::keep);

// Reads from a text; `path` is for messages.
LoadedMesh read_vtk_text(const std::string& path, std::string_view text, FileCells cells = FileCells::keep);

}  // namespace orthodyn
