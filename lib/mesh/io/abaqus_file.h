// What an Abaqus input file says of its mesh. Names are compared in capitals.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
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

// *SOLID SECTION: an element set, and the name of the orientation of its material in capitals ("" for none).
struct AbaqusSection {
  AbaqusMembers elements;
  std::string orientation = {};
};

// *ORIENTATION: the columns are local axes 1, 2, 3; none for a system that is not read.
struct AbaqusOrientation {
  std::string name;  // as spelled
  std::optional<Mat3> axes;
  FilePlace place = {};
};

using AbaqusSets = std::map<std::string, AbaqusSet>;

struct AbaqusFile {
  MeshDraft draft;              // nodes and solid elements
  std::vector<FileFace> faces;  // elements of three or four corners, of shells and the like
  AbaqusSets node_sets, element_sets;
  std::map<std::string, AbaqusSurface> surfaces;
  std::vector<AbaqusSection> sections;
  std::map<std::string, AbaqusOrientation> orientations;
};

// Throws ConfigError.
AbaqusFile read_abaqus_keywords(const std::string& path, std::string_view text);

}  // namespace orthodyn
