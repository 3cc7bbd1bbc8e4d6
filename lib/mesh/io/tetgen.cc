#include "lib/mesh/io/tetgen.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "lib/core/errors.h"
#include "lib/mesh/io/middle_order.h"
#include "lib/mesh/io/text_lines.h"
#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/mesh_draft.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {
namespace {

class TetgenReader {
 public:
  explicit TetgenReader(const std::string& stem) {
    draft_.files = {stem + ".node", stem + ".ele", stem + ".face"};
    draft_.nodes_section = draft_.files[0];
  }

  MeshDraft read(const TetgenTexts& texts) {
    read_nodes(texts.node);
    read_elements(texts.ele);
    if (!texts.face.empty()) read_faces(texts.face);
    return std::move(draft_);
  }

 private:
  // Calls `record` for each announced line. The file must end after them.
  template <class Record>
  void read_records(TextTokens& tokens, std::int64_t announced, const char* what, Record&& record) {
    for (std::int64_t i = 0; i < announced; ++i) {
      if (tokens.at_end()) tokens.fail("the file ends after {} of {} {}; is it truncated?", i, announced, what);
      record();
      tokens.finish_line();
    }
    if (!tokens.at_end())
      tokens.fail("expected the end of the file after {} {}, found {}", announced, what,
                  TextTokens::quoted(tokens.word("a word")));
  }

  void read_nodes(std::string_view text) {
    TextTokens tokens(draft_.files[0], text, {.comment = "#"});
    const std::int64_t count = tokens.count("the number of nodes");
    const std::int64_t dimension = tokens.integer("the dimension");
    if (dimension != 3) tokens.fail("dimension {}; expected 3", dimension);
    const std::int64_t attributes = tokens.peek() ? tokens.count("the number of attributes") : 0;
    const bool markers = tokens.peek() && read_flag(tokens);
    tokens.finish_line();
    read_records(tokens, count, "nodes", [&] {
      FileNode node{.tag = 0, .place = {tokens.line(), 0}};
      node.tag = tokens.integer("the number of a node");
      for (double& x : node.x) x = tokens.real("a coordinate");
      for (std::int64_t k = 0; k < attributes; ++k) tokens.real("an attribute");
      if (markers) {
        if (const std::int64_t marker = tokens.integer("a marker"); marker != 0)
          draft_.node_sets[fmt::format("marker{}", marker)].push_back({node.tag, node.place});
      }
      draft_.nodes.push_back(node);
    });
  }

  void read_elements(std::string_view text) {
    TextTokens tokens(draft_.files[1], text, {.comment = "#"});
    const std::int64_t count = tokens.count("the number of tetrahedra");
    const std::int64_t nodes = tokens.integer("the nodes per tetrahedron");
    if (nodes != 4 && nodes != 10) tokens.fail("{} nodes per tetrahedron; expected 4, or 10 (-o2)", nodes);
    const std::int64_t attributes = tokens.peek() ? tokens.count("the number of attributes") : 0;
    tokens.finish_line();
    if (count == 0) tokens.fail("no tetrahedra");
    read_records(tokens, count, "tetrahedra", [&] {
      FileCell tet{.place = {tokens.line(), 1}};
      tet.tag = tokens.integer("the number of a tetrahedron");
      for (std::int64_t& node : tet.corners()) node = tokens.integer("a node");
      if (nodes == 10)
        for (std::int64_t& node : tet.midsides.emplace()) node = tokens.integer("a node");
      const bool named = attributes > 0;
      tet.region =
          draft_.region_index(named ? fmt::format("region{}", tokens.real("the attribute of a region")) : "body");
      for (std::int64_t k = 1; k < attributes; ++k) tokens.real("an attribute");
      draft_.cells.push_back(tet);
    });
    if (nodes == 10) sort_middles(draft_.nodes, draft_.cells);
  }

  void read_faces(std::string_view text) {
    TextTokens tokens(draft_.files[2], text, {.comment = "#"});
    const std::int64_t count = tokens.count("the number of faces");
    const bool quadratic = !draft_.cells.empty() && draft_.cells.front().midsides.has_value();
    const bool markers = tokens.peek() && read_flag(tokens);
    tokens.finish_line();
    read_records(tokens, count, "faces", [&] {
      FileFace face{.place = {tokens.line(), 2}};
      face.tag = tokens.integer("the number of a face");
      for (std::int64_t& node : face.corners()) node = tokens.integer("a node");
      if (quadratic)
        for (int k = 0; k < 3; ++k) tokens.integer("a node on an edge");
      const std::int64_t marker = markers ? tokens.integer("a marker") : 0;
      while (tokens.peek()) tokens.integer("a neighbour");  // written by tetgen -nn
      if (marker != 0) draft_.surfaces[fmt::format("marker{}", marker)].push_back(face);
    });
  }

  static bool read_flag(TextTokens& tokens) {
    const std::int64_t flag = tokens.integer("0 or 1 (markers)");
    if (flag != 0 && flag != 1) tokens.fail("{} markers; expected 0 or 1", flag);
    return flag == 1;
  }

  MeshDraft draft_;
};

// Numbers for names: "marker7" keeps 7, other names get free numbers.
std::map<std::string, int> numbers_of(const std::string& prefix, const std::vector<std::string>& names,
                                      Warnings& losses) {
  std::map<std::string, int> numbers;
  std::set<int> taken;
  for (const std::string& name : names) {
    if (!name.starts_with(prefix)) continue;
    const char* end = name.data() + name.size();
    int number = 0;
    const auto [stop, error] = std::from_chars(name.data() + prefix.size(), end, number);
    if (error == std::errc() && stop == end && number != 0 && taken.insert(number).second) numbers[name] = number;
  }
  int next = 1;
  for (const std::string& name : names) {
    if (numbers.contains(name)) continue;
    while (taken.contains(next)) ++next;
    taken.insert(next);
    numbers[name] = next;
    losses.push_back(fmt::format("the format cannot hold names: \"{}\" became \"{}{}\"", name, prefix, next));
  }
  return numbers;
}

// The marker of each node, 0 for none. A node in several sets gets the marker of the first.
std::vector<int> markers_of(const Mesh& mesh, Warnings& losses) {
  const auto numbers = numbers_of("marker", names_of(mesh.node_sets), losses);
  std::vector<int> markers(mesh.nodes.size(), 0);
  for (const auto& [name, nodes] : mesh.node_sets) {
    std::size_t lost = 0;
    for (const int n : nodes) {
      int& marker = markers[static_cast<std::size_t>(n)];
      lost += marker != 0;
      if (marker == 0) marker = numbers.at(name);
    }
    if (lost == 0) continue;
    losses.push_back(
        fmt::format("a node can have one marker only: {} nodes of \"{}\" keep that of an earlier set", lost, name));
  }
  return markers;
}

std::string node_text(const Mesh& mesh, Warnings& losses) {
  const std::vector<int> markers = markers_of(mesh, losses);
  TextLines lines;
  lines.line(mesh.nodes.size(), 3, 0, 1);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) lines.line(n + 1, mesh.nodes[n], markers[n]);
  return lines.take();
}

std::string ele_text(const Mesh& mesh, Warnings& losses) {
  const bool plain = mesh.region_names == std::vector<std::string>{"body"};
  std::map<std::string, int> numbers;
  if (!plain) numbers = numbers_of("region", mesh.region_names, losses);
  TextLines lines;
  lines.line(mesh.cells.size(), mesh.cells[0].size(), plain ? 0 : 1);
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    lines.add(e + 1);
    lines.add(FromOne{mesh.cells[e]});
    if (!plain) lines.add(numbers.at(mesh.region_names[static_cast<std::size_t>(mesh.region_of[e])]));
    lines.end_line();
  }
  return lines.take();
}

std::string face_text(const Mesh& mesh, Warnings& losses) {
  const auto numbers = numbers_of("marker", names_of(mesh.surfaces), losses);
  std::size_t count = 0;
  for (const auto& [name, listed] : mesh.surfaces) count += listed.size();
  TextLines lines;
  lines.line(count, 1);
  std::size_t face = 0;
  for (const auto& [name, listed] : mesh.surfaces) {
    const Cells faces = face_cells(mesh, listed);
    for (std::size_t k = 0; k < faces.size(); ++k) lines.line(++face, FromOne{faces[k]}, numbers.at(name));
  }
  return lines.take();
}

const bool tetgen_registered =
    register_mesh_format({.name = "TetGen", .endings = {".node", ".ele"}, .read = read_tetgen, .write = write_tetgen});

}  // namespace

LoadedMesh read_tetgen(const std::string& path, FileCells) {
  const std::string stem = std::filesystem::path(path).replace_extension().string();
  const std::string node = read_text_file(stem + ".node");
  const std::string ele = read_text_file(stem + ".ele");
  const std::string face = std::filesystem::exists(stem + ".face") ? read_text_file(stem + ".face") : "";
  return read_tetgen_text(stem, {node, ele, face});
}

LoadedMesh read_tetgen_text(const std::string& stem, const TetgenTexts& texts) {
  return build_mesh(TetgenReader(stem).read(texts));
}

WrittenMesh write_tetgen(const LoadedMesh& loaded) {
  const Mesh& mesh = loaded.mesh;
  if (!mesh.has_tets_only()) throw ConfigError("TetGen files hold tetrahedra only; write .vtu, .msh or .inp");
  WrittenMesh written;
  written.files.push_back({".node", node_text(mesh, written.losses)});
  written.files.push_back({".ele", ele_text(mesh, written.losses)});
  if (!mesh.surfaces.empty()) written.files.push_back({".face", face_text(mesh, written.losses)});
  return written;
}

}  // namespace orthodyn
