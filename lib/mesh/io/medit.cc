#include "lib/mesh/io/medit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "lib/core/errors.h"
#include "lib/core/spelling.h"
#include "lib/mesh/io/middle_order.h"
#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/mesh_draft.h"

namespace orthodyn {
namespace {

struct MeditSection {
  std::string_view name;
  std::size_t nodes, corners;
  std::optional<CellKind> solid = {};  // empty: a face
};
constexpr std::array<MeditSection, 8> kMeditSections{{{"Tetrahedra", 4, 4, CellKind::tet},
                                                      {"TetrahedraP2", 10, 4, CellKind::tet},
                                                      {"Hexahedra", 8, 8, CellKind::hexahedron},
                                                      {"Prisms", 6, 6, CellKind::wedge},
                                                      {"Pyramids", 5, 5, CellKind::pyramid},
                                                      {"Triangles", 3, 3},
                                                      {"TrianglesP2", 6, 3},
                                                      {"Quadrilaterals", 4, 4}}};

class MeditReader {
 public:
  MeditReader(const std::string& path, std::string_view text) : tokens_(path, text, {.comment = "#"}) {
    draft_.files = {path};
    draft_.nodes_section = "Vertices";
  }

  MeshDraft read() {
    if (tokens_.at_end() || tokens_.word("a keyword") != "MeshVersionFormatted")
      tokens_.fail("expected MeshVersionFormatted; this is not a Medit file in text form (.mesh)");
    value("the version");
    while (!tokens_.at_end()) {
      const std::string name(tokens_.word("a keyword"));
      if (name == "End") break;
      read_section(name);
    }
    if (draft_.cells.empty()) tokens_.fail("no Tetrahedra, Hexahedra, Prisms or Pyramids; did you mesh in 3D?");
    if (is_quadratic()) sort_middles(draft_.nodes, draft_.cells);
    if (!skipped_.empty()) draft_.warn({}, "only the mesh is read; skipped: {}", join(skipped_));
    return std::move(draft_);
  }

 private:
  void read_section(const std::string& name) {
    if (name == "Dimension") {
      if (const std::int64_t dimension = value("the dimension"); dimension != 3)
        tokens_.fail("dimension {}; expected 3", dimension);
      return;
    }
    if (name == "Vertices") return each_line(name, [&] { read_vertex(); });
    for (const MeditSection& section : kMeditSections)
      if (section.name == name) return each_line(name, [&] { read_element(section); });
    for (const char* solid : {"Tetrahedra", "Hexahedra", "Prisms", "Pyramids"})
      if (name.starts_with(solid) && !name.ends_with("Ordering"))
        tokens_.fail("elements {} are not supported; mesh again with Tetrahedra or TetrahedraP2", name);
    if (name.empty() || !std::isalpha(static_cast<unsigned char>(name[0])))
      tokens_.fail("expected a keyword, found {}; does the section have more lines than it announces?",
                   TextTokens::quoted(name));
    skipped_.push_back(name);
    tokens_.skip_line();
    while (!tokens_.at_end() && !std::isalpha(static_cast<unsigned char>(tokens_.peek()))) tokens_.skip_line();
  }

  // The integer after a keyword, on the same or the next line.
  std::int64_t value(const char* what) {
    if (!tokens_.peek()) tokens_.finish_line();
    const std::int64_t found = tokens_.count(what);
    tokens_.finish_line();
    return found;
  }

  template <class Read>
  void each_line(const std::string& section, Read&& read) {
    const std::int64_t announced = value("a number of lines");
    for (std::int64_t k = 0; k < announced; ++k) {
      if (tokens_.at_end()) tokens_.fail("the file ends after {} of {} {}; is it truncated?", k, announced, section);
      number_ = k + 1;
      place_ = {tokens_.line(), 0};
      read();
      tokens_.finish_line();
    }
  }

  void read_vertex() {
    FileNode node{.tag = number_, .place = place_};
    for (double& x : node.x) x = tokens_.real("a coordinate");
    if (const std::int64_t reference = tokens_.integer("a reference"); reference != 0)
      draft_.node_sets[fmt::format("vertices{}", reference)].push_back({node.tag, place_});
    draft_.nodes.push_back(node);
  }

  void read_element(const MeditSection& section) {
    std::array<std::int64_t, 10> nodes{};
    for (std::size_t k = 0; k < section.nodes; ++k) nodes[k] = tokens_.integer("a vertex");
    const std::int64_t reference = tokens_.integer("a reference");
    const auto corners_end = nodes.begin() + static_cast<std::ptrdiff_t>(section.corners);
    if (!section.solid) {
      if (reference == 0) return;
      FileFace face{.tag = number_, .sides = section.corners, .place = place_};
      std::copy(nodes.begin(), corners_end, face.nodes.begin());
      draft_.surfaces[fmt::format("surface{}", reference)].push_back(face);
      return;
    }
    FileCell cell{.tag = static_cast<std::int64_t>(draft_.cells.size()) + 1, .kind = *section.solid, .place = place_};
    std::copy(nodes.begin(), corners_end, cell.nodes.begin());
    if (section.nodes == 10) std::copy(corners_end, nodes.end(), cell.midsides.emplace().begin());
    cell.region = draft_.region_index(fmt::format("region{}", reference));
    draft_.cells.push_back(std::move(cell));
  }

  bool is_quadratic() const {
    return std::all_of(draft_.cells.begin(), draft_.cells.end(),
                       [](const FileCell& c) { return c.midsides.has_value(); });
  }

  TextTokens tokens_;
  MeshDraft draft_;
  std::vector<std::string> skipped_;
  std::int64_t number_ = 0;  // of the current record in its section, from 1
  FilePlace place_;
};

const bool medit_registered =
    register_mesh_format({.name = "Medit", .endings = {".mesh", ".meshb"}, .read = read_medit});

}  // namespace

LoadedMesh read_medit(const std::string& path, FileCells cells) {
  if (in_capitals(std::filesystem::path(path).extension().string()) == ".MESHB")
    throw ConfigError(path, "binary Medit files are not supported; write the text form, .mesh");
  return read_medit_text(path, read_text_file(path), cells);
}

LoadedMesh read_medit_text(const std::string& path, std::string_view text, FileCells cells) {
  return build_mesh(MeditReader(path, text).read(), cells);
}

}  // namespace orthodyn
