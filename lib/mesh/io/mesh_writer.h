// Writes meshes in the formats that can be read. Each function makes texts; nothing touches a disk.
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
  std::vector<MeshText> files;
  Warnings losses;  // what the format cannot hold, one sentence each
};

WrittenMesh write_gmsh22(const LoadedMesh& loaded);
WrittenMesh write_gmsh41(const LoadedMesh& loaded);

// Regions as sets, with materials if all have one; the node set "fixed" as .bou file.
WrittenMesh write_vega(const LoadedMesh& loaded);

// ASCII, with the cell data "region" and its names, node sets as point data "nodes:NAME", and all
// other cell data.
WrittenMesh write_vtu(const LoadedMesh& loaded);

// .node, .ele, .face. Names are lost but for "region<k>" and "marker<k>".
WrittenMesh write_tetgen(const LoadedMesh& loaded);

WrittenMesh write_abaqus(const LoadedMesh& loaded);

// Of use to several formats. -------------------------------------------------------------------

// The sentence for what is lost, if there is any: "surfaces left, right".
void note_loss(WrittenMesh& written, const std::string& what, const std::vector<std::string>& names);

// Names that were given so far, as the format compares them.
struct TakenNames {
  bool capitals_differ = true;
  std::set<std::string> names = {};
};

// `cleaned`, or with "_2", "_3", ... behind it where that is taken; what becomes of `name` is noted.
std::string unique_name(TakenNames& taken, const std::string& name, const std::string& cleaned, WrittenMesh& written);

template <class Map>
std::vector<std::string> names_of(const Map& map) {
  std::vector<std::string> names;
  for (const auto& [name, members] : map) names.push_back(name);
  return names;
}

void note_lost_materials_and_data(WrittenMesh& written, const LoadedMesh& loaded);

}  // namespace orthodyn
