// Mesh files of every format, chosen by the ending of their name.
#pragma once

#include <string>
#include <vector>

#include "lib/mesh/loaded_mesh.h"
#include "lib/mesh/io/mesh_writer.h"

namespace orthodyn {

struct MeshFormat {
  std::string name;                  // "Gmsh"
  std::vector<std::string> endings;  // ".msh"
  LoadedMesh (*read)(const std::string& path);
  bool materials;  // the format can hold them
  WrittenMesh (*write)(const LoadedMesh& loaded);  // null: the format is only read
};

const std::vector<MeshFormat>& mesh_formats();

// Throws ConfigError, listing the endings, if no format has this one (capitals do not matter).
const MeshFormat& mesh_format_of(const std::string& path);

// Throws ConfigError.
LoadedMesh read_mesh(const std::string& path);

// Writes what the ending of `path` says, beside each other if there are several files, and returns what the
// format could not hold. Throws ConfigError if a file is there already and `replace` is false (nothing
// is written then), if the format cannot be written, or if a file cannot (what was there stays then).
Warnings write_mesh(const LoadedMesh& loaded, const std::string& path, bool replace);

// Multiplies all coordinates. Throws ConfigError, beginning with `source`, if a volume can then no longer be
// represented.
void scale_mesh(TetMesh& mesh, double factor, const std::string& source);

}  // namespace orthodyn
