// Meshes from and to files on the disk, in the format that the ending of the name says.
#pragma once

#include <string>

#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

// Throws ConfigError. Names are UTF-8.
LoadedMesh read_mesh(const std::string& path);

// Names of regions, sets, materials and cell data that are not UTF-8, as the files that we write are, are taken for
// Latin-1, with a warning.
void make_names_utf8(LoadedMesh& loaded, const std::string& path);

// Writes what the ending of `path` says, beside each other if there are several files, and returns what the
// format could not hold. Throws ConfigError if a file is there already and `replace` is false (nothing
// is written then), if the format cannot be written, or if a file cannot (what was there stays then).
Warnings write_mesh(const LoadedMesh& loaded, const std::string& path, bool replace);

// Multiplies all coordinates. Throws ConfigError, beginning with `source`, if a volume can then no longer be
// represented.
void scale_mesh(TetMesh& mesh, double factor, const std::string& source);

}  // namespace orthodyn
