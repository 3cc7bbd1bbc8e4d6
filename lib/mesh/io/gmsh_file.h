// What a Gmsh file says, before it becomes a TetMesh: tags instead of indices, and the line of
// everything. Filled by the readers of both versions, turned into a mesh by read_gmsh().
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/mesh_draft.h"

namespace orthodyn {

// What a type of element is read as.
struct GmshType {
  enum class Role { ignored, point, line, face, cell };

  Role role = Role::ignored;
  std::size_t nodes = 0;    // in the file
  std::size_t corners = 0;  // the first of them
  CellKind kind = CellKind::tet;
};

// An element of a draft with its physical groups, an index into GmshFile::group_sets.
template <class Element>
struct Grouped {
  Element element;
  int groups;
};

// Of the names of physical groups in format 2.0, which do not say.
inline constexpr int kAnyDimension = -1;

struct GmshFile {
  using DimTag = std::pair<int, int>;

  std::map<DimTag, std::string> names;  // of physical groups
  std::vector<FileNode> nodes;
  std::vector<Grouped<FileNodeUse>> points;  // only those in a physical point
  std::vector<Grouped<FileNodeUse>> curves;  // nodes of lines that are in a physical curve
  std::vector<Grouped<FileFace>> faces;      // only those in a physical surface
  std::vector<Grouped<FileCell>> cells;
  // Sets of physical tags that elements refer to; ascending, no duplicates. The first is empty.
  // Negative where the group is oriented against the element.
  std::vector<std::vector<int>> group_sets = {{}};
  std::map<std::vector<int>, int> group_set_index = {{{}, 0}};
  std::map<std::string, int> section_lines;  // where each section began

  // 4.1 only: the group set of each model entity.
  std::map<DimTag, int> entity_groups;
};

// `$Nodes` and the line it is on.
struct GmshSection {
  std::string name;
  int line;
};

using GmshSectionReader = std::function<void(TextTokens&, const GmshSection&, GmshFile&)>;
using GmshSectionReaders = std::map<std::string, GmshSectionReader>;

GmshSectionReaders gmsh_v2_sections();
GmshSectionReaders gmsh_v4_sections();

// Reads $MeshFormat, chooses the readers by version, and reads all sections; unknown ones are
// skipped.
GmshFile read_gmsh_sections(TextTokens& tokens);

// Of use to both formats. ---------------------------------------------------------------------

// The tag of a model entity or physical group.
int read_tag(TextTokens& tokens, const char* what);

// Before each record of a list: the section must not be over while `done` of `announced` are read.
void expect_record(TextTokens& tokens, const GmshSection& section, std::int64_t done, std::int64_t announced,
                   const char* records);

// The line `$End<name>`.
void end_section(TextTokens& tokens, const GmshSection& section);

// The index of this set of physical tags in group_sets.
int intern_groups(GmshFile& file, std::vector<int> groups);

// Refuses everything but points, lines, and elements of first or second order.
GmshType check_element_type(const TextTokens& tokens, std::int64_t type);

// Reads the nodes of an element up to the end of the line.
void read_element_nodes(TextTokens& tokens, const GmshType& type, std::int64_t tag, int groups, GmshFile& file);

}  // namespace orthodyn
