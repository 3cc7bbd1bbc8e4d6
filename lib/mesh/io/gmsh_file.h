// The content of a Gmsh file before it becomes a Mesh: tags instead of indices, each with its line. Filled by the
// readers of both formats; read_gmsh() builds the mesh.
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

// An element type.
struct GmshType {
  enum class Role { ignored, point, line, face, cell };

  Role role = Role::ignored;
  std::size_t nodes = 0;    // per element
  std::size_t corners = 0;  // the first nodes
  CellKind kind = CellKind::tet;
};

// An element with its physical groups, an index into GmshFile::group_sets.
template <class Element>
struct Grouped {
  Element element;
  int groups;
};

// Dimension of group names in format 2.0, which does not store it.
inline constexpr int kAnyDimension = -1;

struct GmshFile {
  using DimTag = std::pair<int, int>;

  std::map<DimTag, std::string> names;  // of physical groups
  std::vector<FileNode> nodes;
  std::vector<Grouped<FileNodeUse>> points;  // in a physical point
  std::vector<Grouped<FileNodeUse>> curves;  // nodes of lines in a physical curve
  std::vector<Grouped<FileFace>> faces;      // in a physical surface
  std::vector<Grouped<FileCell>> cells;
  // Distinct sets of physical tags, each ascending and without duplicates; the first is empty. A tag is negative if the
  // group has the opposite orientation of the element.
  std::vector<std::vector<int>> group_sets = {{}};
  std::map<std::vector<int>, int> group_set_index = {{{}, 0}};
  std::map<std::string, int> section_lines;  // line where each section begins

  // 4.1 only: the group set of each model entity.
  std::map<DimTag, int> entity_groups;
};

// A section, such as "Nodes", and the line where it starts.
struct GmshSection {
  std::string name;
  int line;
};

using GmshSectionReader = std::function<void(TextTokens&, const GmshSection&, GmshFile&)>;
using GmshSectionReaders = std::map<std::string, GmshSectionReader>;

GmshSectionReaders gmsh_v2_sections();
GmshSectionReaders gmsh_v4_sections();

// Reads all sections with the readers of the version in $MeshFormat. Skips unknown sections.
GmshFile read_gmsh_sections(TextTokens& tokens);

// Whether the line after $MeshFormat says that the file is binary.
bool is_binary_gmsh(std::string_view text);

// Converts a binary file to ASCII, without the sections that are not read. The byte order must be that of this machine.
// Throws ConfigError "file: byte N of a binary Gmsh file: found, remedy" if the file ends early or announces more than
// it contains. Precondition: is_binary_gmsh().
std::string ascii_of_binary_gmsh(const std::string& path, std::string_view bytes);

// Shared by both formats. ---------------------------------------------------------------------

// Reads the tag of a model entity or physical group.
int read_tag(TextTokens& tokens, const char* what);

// Call before each record. Fails if the section or file ends after `done` of `announced` records.
void expect_record(TextTokens& tokens, const GmshSection& section, std::int64_t done, std::int64_t announced,
                   const char* records);

// Reads the line `$End<name>`.
void end_section(TextTokens& tokens, const GmshSection& section);

// The index of this set of physical tags in group_sets; adds it if it is new.
int intern_groups(GmshFile& file, std::vector<int> groups);

// Fails for element types that are not supported.
GmshType check_element_type(const TextTokens& tokens, std::int64_t type);

// Reads the nodes of an element up to the end of the line.
void read_element_nodes(TextTokens& tokens, const GmshType& type, std::int64_t tag, int groups, GmshFile& file);

}  // namespace orthodyn
