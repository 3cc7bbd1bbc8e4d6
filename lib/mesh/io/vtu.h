// Reads and writes VTK XML files of unstructured grids (.vtu). Reads ASCII, base64, and appended data (raw or base64),
// uncompressed or zlib, in either byte order. Writes ASCII, exact to the last digit and readable by every version of
// VTK.
//
// Format: Kitware, VTK file formats, "XML file formats". Frames of a run have this format, too.
#pragma once

#include <string>
#include <string_view>

#include "lib/mesh/io/mesh_format.h"

namespace orthodyn {

// build_vtk_mesh() describes the result. The field data array "region_names" (strings, or character codes with a zero
// after each name) names the regions by number. Throws ConfigError "file:line: array, found, remedy". Memory use is
// bounded by the file size, whatever counts the file announces: the numbers of all encoded arrays together, at 8 bytes
// each, may take at most 1000 times the file size plus 1 MB.
LoadedMesh read_vtu(const std::string& path, FileCells cells = FileCells::keep);

// Reads from a text; `path` is for messages.
LoadedMesh read_vtu_text(const std::string& path, std::string_view text, FileCells cells = FileCells::keep);

// Writes regions as the cell data "region" with their names, node sets as point data "nodes:NAME", and all cell data.
WrittenMesh write_vtu(const LoadedMesh& loaded);

}  // namespace orthodyn
