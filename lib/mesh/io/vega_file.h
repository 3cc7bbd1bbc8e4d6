// The content of a .veg file: a draft of the mesh, element sets, materials and regions.
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
  std::vector<FileNodeUse> elements;  // element numbers, as in the file
  FilePlace place;
};

struct VegaRegion {
  std::string set, material;
  FilePlace place;
};

struct VegaFile {
  MeshDraft draft;  // nodes and cells, without regions
  std::int64_t first_element = 1;
  std::vector<VegaSet> sets;
  std::map<std::string, MeshMaterial> materials;
  std::vector<VegaRegion> regions;
};

// Reads the file and its includes. Throws ConfigError.
VegaFile read_vega_sections(const std::string& path, std::string_view text);

// Reads the line after *MATERIAL: "ENU, density, E, nu" or "ORTHOTROPIC..., density, E1, E2, E3, ...". Throws
// ConfigError for other kinds, a wrong count of numbers, and axes that deviate from orthonormality by more than 1e-6;
// smaller deviations are repaired with a warning.
MeshMaterial read_vega_material(TextTokens& tokens, const std::string& name, Warnings& warnings);

}  // namespace orthodyn
