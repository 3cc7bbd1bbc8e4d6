#include "lib/mesh/io/gmsh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <string_view>

namespace orthodyn {
namespace {

constexpr const char* kConvert = "save it as ASCII 2.2 or 4.1: \"gmsh in.msh -save -format msh22 -o out.msh\"";

GmshSection begin_section(TextTokens& tokens) {
  const int line = tokens.line();
  const std::string_view word = tokens.word("a section");
  if (word.size() < 2 || word[0] != '$')
    tokens.fail("expected the start of a section ($...), found {}", TextTokens::quoted(word));
  GmshSection section{std::string(word.substr(1)), line};
  tokens.finish_line();
  return section;
}

void skip_section(TextTokens& tokens, const GmshSection& section) {
  const std::string end = "$End" + section.name;
  while (!tokens.at_end()) {
    const bool ended = tokens.word("a word") == end;
    tokens.skip_line();
    if (ended) return;
  }
  tokens.fail("the file ends inside {} (line {}); is it truncated?", TextTokens::quoted("$" + section.name),
              section.line);
}

// The text between the first and the last quote; names may contain blanks and quotes.
std::string read_name(TextTokens& tokens) {
  tokens.peek();
  std::string_view rest = tokens.rest_of_line();
  const std::size_t last = rest.find_last_not_of(" \t\r");
  rest = rest.substr(0, last == std::string_view::npos ? 0 : last + 1);
  if (rest.size() < 2 || rest.front() != '"' || rest.back() != '"')
    tokens.fail("expected a name in quotes, found {}", TextTokens::quoted(rest));
  return std::string(rest.substr(1, rest.size() - 2));
}

void read_names(TextTokens& tokens, const GmshSection& section, GmshFile& file, bool with_dimension) {
  const std::int64_t announced = tokens.count("the number of physical names");
  tokens.finish_line();
  for (std::int64_t i = 0; i < announced; ++i) {
    expect_record(tokens, section, i, announced, "names");
    const std::int64_t dim = with_dimension ? tokens.integer("the dimension of a physical group") : kAnyDimension;
    if (with_dimension && (dim < 0 || dim > 3)) tokens.fail("dimension {}; expected 0 to 3", dim);
    const int tag = read_tag(tokens, "the tag of a physical group");
    if (!file.names.emplace(GmshFile::DimTag(static_cast<int>(dim), tag), read_name(tokens)).second)
      tokens.fail("physical group {} of dimension {} is named twice", tag, dim);
    tokens.skip_line();
  }
  end_section(tokens, section);
}

[[noreturn]] void refuse_version(const TextTokens& tokens, int line, const std::string& version) {
  tokens.fail_at(line, "Gmsh format {} is not supported; supported: 2.0 to 2.2 and 4.1; {}", version, kConvert);
}

// Leaves the cursor after $EndMeshFormat.
GmshSectionReaders read_format(TextTokens& tokens, const GmshSection& section) {
  const double version = tokens.real("the version of the format");
  const std::int64_t binary = tokens.integer("the file type (0 = ASCII)");
  const bool second = version == 2 || version == 2.1 || version == 2.2;  // names of groups in 2.0 have no dimension
  if (!second && version != 4.1) refuse_version(tokens, tokens.line(), fmt::format("{}", version));
  if (binary != 0) tokens.fail("file type {}; {}", binary, kConvert);
  tokens.integer("the size of numbers");
  tokens.finish_line();
  end_section(tokens, section);
  GmshSectionReaders readers = second ? gmsh_v2_sections() : gmsh_v4_sections();
  readers["PhysicalNames"] = [with_dimension = version != 2](TextTokens& t, const GmshSection& s, GmshFile& f) {
    read_names(t, s, f, with_dimension);
  };
  return readers;
}

// Gmsh allows $Comments before $MeshFormat.
GmshSection find_format(TextTokens& tokens) {
  while (!tokens.at_end()) {
    if (tokens.peek() != '$') break;
    GmshSection section = begin_section(tokens);
    if (section.name == "MeshFormat") return section;
    if (section.name == "NOD") refuse_version(tokens, section.line, "1");
    skip_section(tokens, section);
  }
  tokens.fail("no $MeshFormat: this is not a Gmsh mesh file (.msh)");
}

}  // namespace

GmshFile read_gmsh_sections(TextTokens& tokens) {
  GmshSectionReaders readers = read_format(tokens, find_format(tokens));
  GmshFile file;
  while (!tokens.at_end()) {
    const GmshSection section = begin_section(tokens);
    const auto reader = readers.find(section.name);
    if (reader == readers.end()) {
      skip_section(tokens, section);
      continue;
    }
    const auto [first, is_new] = file.section_lines.emplace(section.name, section.line);
    if (!is_new)
      tokens.fail_at(section.line, "section ${} occurs twice (first in line {})", section.name, first->second);
    reader->second(tokens, section, file);
  }
  return file;
}

int read_tag(TextTokens& tokens, const char* what) {
  const std::int64_t tag = tokens.integer(what);
  constexpr std::int64_t kMax = std::numeric_limits<int>::max();
  if (tag < -kMax || tag > kMax) tokens.fail("{} is {}; at most {} is allowed", what, tag, kMax);
  return static_cast<int>(tag);
}

void expect_record(TextTokens& tokens, const GmshSection& section, std::int64_t done, std::int64_t announced,
                   const char* records) {
  if (tokens.at_end())
    tokens.fail("the file ends after {} of {} {} (${} in line {}); is it truncated?", done, announced, records,
                section.name, section.line);
  if (tokens.peek() == '$')
    tokens.fail("found {} after {} of the {} {} announced (${} in line {})", TextTokens::quoted(tokens.word("a word")),
                done, announced, records, section.name, section.line);
}

void end_section(TextTokens& tokens, const GmshSection& section) {
  const std::string end = "$End" + section.name;
  const std::string_view found = tokens.word(end.c_str());
  if (found != end)
    tokens.fail("expected {}, found {}; the count at the start of the section (line {}) may be too small", end,
                TextTokens::quoted(found), section.line);
  tokens.finish_line();
}

int intern_groups(GmshFile& file, std::vector<int> groups) {
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  const auto [entry, is_new] = file.group_set_index.emplace(groups, static_cast<int>(file.group_sets.size()));
  if (is_new) file.group_sets.push_back(std::move(groups));
  return entry->second;
}

GmshType check_element_type(const TextTokens& tokens, std::int64_t type) {
  using enum GmshType::Role;
  static const std::map<std::int64_t, GmshType> types{
      {1, {line, 2, 2}},
      {8, {line, 3, 2}},
      {26, {ignored, 4}},
      {27, {ignored, 5}},
      {28, {ignored, 6}},  // lines of higher order
      {15, {point, 1, 1}},
      {2, {face, 3, 3}},
      {9, {face, 6, 3}},
      {3, {face, 4, 4}},
      {16, {face, 8, 4}},
      {10, {face, 9, 4}},
      {4, {cell, 4, 4, CellKind::tet}},
      {11, {cell, 10, 4, CellKind::tet}},
      {5, {cell, 8, 8, CellKind::hexahedron}},
      {17, {cell, 20, 8, CellKind::hexahedron}},
      {12, {cell, 27, 8, CellKind::hexahedron}},
      {6, {cell, 6, 6, CellKind::wedge}},
      {18, {cell, 15, 6, CellKind::wedge}},
      {13, {cell, 18, 6, CellKind::wedge}},
      {7, {cell, 5, 5, CellKind::pyramid}},
      {19, {cell, 13, 5, CellKind::pyramid}},
      {14, {cell, 14, 5, CellKind::pyramid}},
  };
  const auto found = types.find(type);
  if (found != types.end()) return found->second;
  tokens.fail(
      "element type {} is not supported; supported: tetrahedra, hexahedra, prisms and pyramids of first or second "
      "order, triangles, quadrangles, lines and points: set Mesh.ElementOrder = 1 or 2",
      type);
}

// Edges in the order of Gmsh's manual, "node ordering".
const std::vector<std::array<std::size_t, 2>>& gmsh_edges_of(CellKind kind) {
  using Edges = std::vector<std::array<std::size_t, 2>>;
  static const Edges pyramid{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}};
  static const Edges wedge{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}};
  static const Edges hexahedron{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                                {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
  return kind == CellKind::pyramid ? pyramid : kind == CellKind::wedge ? wedge : hexahedron;
}

// Nodes within the faces of complete elements, in the order of Gmsh's manual, then the node within a hexahedron.
void add_inner_nodes(FileCell& cell, std::span<const std::int64_t> nodes) {
  using Faces = std::vector<std::array<std::size_t, 4>>;
  static const Faces pyramid{{0, 3, 2, 1}}, wedge{{0, 1, 4, 3}, {0, 3, 5, 2}, {1, 2, 5, 4}};
  static const Faces hexahedron{{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}};
  const Faces& faces = cell.kind == CellKind::pyramid ? pyramid : cell.kind == CellKind::wedge ? wedge : hexahedron;
  if (nodes.size() < faces.size()) return;
  for (std::size_t f = 0; f < faces.size(); ++f) cell.add_face_middle(faces[f], nodes[f]);
  if (nodes.size() > faces.size()) cell.add_centre(nodes[faces.size()]);
}

void read_element_nodes(TextTokens& tokens, const GmshType& type, std::int64_t tag, int groups, GmshFile& file) {
  using enum GmshType::Role;
  const FilePlace place{tokens.line()};
  const auto read = [&](auto&& nodes) {
    for (std::int64_t& node : nodes) node = tokens.integer("a node tag");
  };
  // Faces, lines and points in no physical group are skipped.
  const bool grouped = !file.group_sets[static_cast<std::size_t>(groups)].empty();
  if (type.role == cell) {
    file.cells.push_back({{.tag = tag, .kind = type.kind, .place = place}, groups});
    FileCell& cell = file.cells.back().element;
    read(cell.corners());
    if (type.nodes > type.corners && type.kind == CellKind::tet) {
      read(cell.midsides.emplace());
      std::swap((*cell.midsides)[4], (*cell.midsides)[5]);  // Gmsh has edge 23 before 13
    } else if (type.nodes > type.corners) {
      std::vector<std::int64_t> middles(type.nodes - type.corners);
      read(middles);
      const auto& edges = gmsh_edges_of(type.kind);
      cell.add_edge_middles(edges, middles);
      add_inner_nodes(cell, std::span(middles).subspan(edges.size()));
    }
  } else if (type.role == face && grouped) {
    FileFace face{.tag = tag, .sides = type.corners, .place = place};
    read(face.corners());
    file.faces.push_back({face, groups});
    if (type.nodes > type.corners) return tokens.skip_line();  // the other nodes belong to the cell behind the face
  } else if (type.role == line && grouped) {
    for (std::size_t k = 0; k < type.nodes; ++k) file.curves.push_back({{tokens.integer("a node tag"), place}, groups});
  } else if (type.role == point && grouped) {
    file.points.push_back({{tokens.integer("a node tag"), place}, groups});
  } else {
    return tokens.skip_line();
  }
  tokens.finish_line();
}

}  // namespace orthodyn
