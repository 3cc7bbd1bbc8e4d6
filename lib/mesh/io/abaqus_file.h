// What an Abaqus input file says of its mesh. Names are compared in capitals.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lib/mesh/mesh_draft.h"

namespace orthodyn {

// Numbers first, first + step, ... up to last, or the members of another set.
struct AbaqusMembers {
  std::int64_t first = 0, last = 0, step = 1;
  std::string set = {};  // in capitals; empty for numbers
  FilePlace place = {};
};

struct AbaqusSet {
  std::string name;  // as first spelled
  std::vector<AbaqusMembers> members;
  int order = 0;  // of the last line that added to it
};


struct AbaqusFace {
  AbaqusMembers elements;
  std::size_t side = 0;  // 0 to 5 for S1 to S6
};

struct AbaqusSurface {
  std::string name;
  std::vector<AbaqusFace> faces;
};

using AbaqusSets = std::map<std::string, AbaqusSet>;

struct AbaqusFile {
  MeshDraft draft;              // nodes and solid elements
  std::vector<FileFace> faces;  // elements of three or four corners, of shells and the like
  AbaqusSets node_sets, element_sets;
  std::map<std::string, AbaqusSurface> surfaces;
  std::vector<AbaqusMembers> sections;  // the element set of each *SOLID SECTION
};

// Throws ConfigError.
AbaqusFile read_abaqus_keywords(const std::string& path, std::string_view text);

}  // namespace orthodyn
