// What a .veg file says: a draft of the mesh, sets of elements, materials and regions.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/mesh_draft.h"

namespace orthodyn {

struct VegaSet {
  std::string name;
  std::vector<FileNodeUse> elements;  // numbers of elements, as in the file
  FilePlace place;
};

struct VegaRegion {
  std::string set, material;
  FilePlace place;
};

struct VegaFile {
  MeshDraft draft;  // nodes and tets; regions are not assigned yet
  std::int64_t first_element = 1;
  std::vector<VegaSet> sets;
  std::map<std::string, MeshMaterial> materials;
  std::vector<VegaRegion> regions;
};

// Reads the file and what it includes. Throws ConfigError.
VegaFile read_vega_sections(const std::string& path, std::string_view text);

// The line below *MATERIAL: "ENU, density, E, nu" or "ORTHOTROPIC..., density, E1, E2, E3, ...". Leaves the cursor
// behind the line. Throws ConfigError for other kinds, for a wrong count of numbers, and for axes that are not
// orthonormal by more than rounding; warns where these were repaired.
MeshMaterial read_vega_material(TextTokens& tokens, const std::string& name, Warnings& warnings);

}  // namespace orthodyn
