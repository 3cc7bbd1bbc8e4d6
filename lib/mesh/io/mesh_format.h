// A mesh file format: its reader, its writer, and what it cannot represent. Each format registers itself:
//
//   const bool gmsh_registered =
//       register_mesh_format({.name = "Gmsh", .endings = {".msh"}, .read = read_gmsh, .write = write_gmsh41});
//
// `orthodyn convert --help`, `orthodyn list meshes` and messages about endings list the registered formats.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

struct MeshText {
  std::string ending;  // of the file name, ".node"
  std::string text;
};

struct WrittenMesh {
  std::vector<MeshText> files = {};
  Warnings losses = {};  // names and sets that changed or are missing, one sentence each
};

struct MeshFormat {
  std::string name;                  // "Gmsh"
  std::vector<std::string> endings;  // ".msh", lower case; unique among all formats
  // Throws ConfigError "file:line: found, remedy".
  LoadedMesh (*read)(const std::string& path, FileCells cells);
  // Returns the texts of the files; does not access the disk. Null: the format is read-only.
  WrittenMesh (*write)(const LoadedMesh& loaded) = nullptr;
  bool brings_materials = false;  // files may define materials
  // What written files can contain beside nodes, elements and regions.
  bool holds_materials = false;
  bool holds_surfaces = true;
  bool holds_cell_data = false;
};

// Registers a format and returns true. Call before main() or while a plugin is loaded.
bool register_mesh_format(MeshFormat format);

// All formats, ascending by name.
const std::vector<MeshFormat>& mesh_formats();

// ".inp (Abaqus), .msh (Gmsh), ..."
std::string known_mesh_endings();

// The format of a file by the ending of its name, in any case. Throws ConfigError with the known endings if there is
// none.
const MeshFormat& mesh_format_of(const std::string& path);
// As above, for a file to be written: the message gives no advice on conversion. `write` may be null.
const MeshFormat& mesh_format_to_write(const std::string& path);

// A sentence for each kind of content of the mesh that the format cannot represent.
Warnings losses_in(const MeshFormat& format, const LoadedMesh& loaded);

// Shared by several formats. -------------------------------------------------------------------

// Adds "the format cannot hold surfaces: lost left, right" unless `names` is empty.
void note_loss(Warnings& losses, const std::string& what, const std::vector<std::string>& names);

// Names used so far in a written file. `capitals_differ`: the format distinguishes upper and lower case.
struct TakenNames {
  bool capitals_differ = true;
  std::set<std::string> names = {};
};

// Returns `cleaned`, with "_2", "_3", ... appended if it is taken. Adds a loss if the result differs from `name`.
std::string unique_name(TakenNames& taken, const std::string& name, const std::string& cleaned, Warnings& losses);

template <class Map>
std::vector<std::string> names_of(const Map& map) {
  std::vector<std::string> names;
  for (const auto& [name, members] : map) names.push_back(name);
  return names;
}

}  // namespace orthodyn
