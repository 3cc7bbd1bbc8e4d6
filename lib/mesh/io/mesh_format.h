// A kind of mesh file: how it is read and written, and what it cannot hold. A format is one source, or a few whose
// names begin alike, and registers itself:
//
//   const bool gmsh_registered =
//       register_mesh_format({.name = "Gmsh", .endings = {".msh"}, .read = read_gmsh, .write = write_gmsh41});
//
// The help of `orthodyn convert`, `orthodyn list meshes` and the messages about endings follow from the table.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

struct MeshText {
  std::string ending;  // of the file, ".node"
  std::string text;
};

struct WrittenMesh {
  std::vector<MeshText> files = {};
  Warnings losses = {};  // what became of names and sets, one sentence each
};

struct MeshFormat {
  std::string name;                  // "Gmsh"
  std::vector<std::string> endings;  // ".msh", in small letters; no two formats have the same
  // Throws ConfigError "file:line: found, remedy".
  LoadedMesh (*read)(const std::string& path);
  // Makes texts, touches no disk. Null: the format is only read.
  WrittenMesh (*write)(const LoadedMesh& loaded) = nullptr;
  bool brings_materials = false;  // files may define the materials of their regions
  // What is false is lost in writing. Every format holds nodes, elements and regions.
  bool holds_materials = false;
  bool holds_surfaces = true;
  bool holds_cell_data = false;
};

// Adds a line to the table; returns true. To be called before main() or while a plugin is loaded.
bool register_mesh_format(MeshFormat format);

// Ascending by name.
const std::vector<MeshFormat>& mesh_formats();

// ".inp (Abaqus), .msh (Gmsh), ..."
std::string known_mesh_endings();

// Throws ConfigError, listing the endings, if no format has the one of `path` (capitals do not matter).
const MeshFormat& mesh_format_of(const std::string& path);
// The same of a file that is to be written, without advice on how to convert it. Its `write` may be null.
const MeshFormat& mesh_format_to_write(const std::string& path);

// A sentence for each kind of content of the mesh that the format cannot hold.
Warnings losses_in(const MeshFormat& format, const LoadedMesh& loaded);

// Of use to several formats. -------------------------------------------------------------------

// Adds the sentence for what is lost, if there is any: "surfaces: lost left, right".
void note_loss(Warnings& losses, const std::string& what, const std::vector<std::string>& names);

// Names that were given so far, as the format compares them.
struct TakenNames {
  bool capitals_differ = true;
  std::set<std::string> names = {};
};

// `cleaned`, or with "_2", "_3", ... behind it where that is taken; what becomes of `name` is added to the losses.
std::string unique_name(TakenNames& taken, const std::string& name, const std::string& cleaned, Warnings& losses);

template <class Map>
std::vector<std::string> names_of(const Map& map) {
  std::vector<std::string> names;
  for (const auto& [name, members] : map) names.push_back(name);
  return names;
}

}  // namespace orthodyn
