// Meshes of solid cells in VTK's XML files of unstructured grids (.vtu). Read: ASCII, base64, and appended data (raw
// or base64), uncompressed or by zlib, either byte order. Written: ASCII, exact to the last digit and readable by
// every version.
//
// Format: Kitware, VTK file formats, "XML file formats". The frames of a run are such files.
#pragma once

#include <string>
#include <string_view>

#include "lib/mesh/io/mesh_format.h"

namespace orthodyn {

// What becomes of cells and arrays: see build_vtk_mesh(). The field data array "region_names" (strings,
// or codes of characters, each name ended by a zero) names the regions by their number. Throws ConfigError
// "file:line: array, found, remedy". Memory use is bounded by the size of the file, whatever counts it
// announces: the numbers of all packed arrays together, 8 bytes each, must not exceed 1000 times that size
// and 1 MB.
LoadedMesh read_vtu(const std::string& path);

// The same from a text; `path` is for messages.
LoadedMesh read_vtu_text(const std::string& path, std::string_view text);

// Regions as the cell data "region" with their names, node sets as point data "nodes:NAME", all other cell data.
WrittenMesh write_vtu(const LoadedMesh& loaded);

}  // namespace orthodyn
