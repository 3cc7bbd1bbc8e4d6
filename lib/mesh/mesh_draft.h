// The content of a mesh file before it becomes a Mesh: tags of the file instead of indices, each with its place. The
// readers of all formats fill it.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lib/core/errors.h"
#include "lib/core/types.h"
#include "lib/mesh/cell_kind.h"
#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

struct FilePlace {
  int line = 0;  // 0: the file has no lines
  int file = 0;  // index into MeshDraft::files
};

struct FileNode {
  std::int64_t tag = 0;
  FilePlace place;
  Vec3 x = Vec3::Zero();
};

// The node in the middle of the edge between two corners.
struct FileEdge {
  std::int64_t a = 0, b = 0, middle = 0;
};

// A solid element; corners in the order of cell_kind.h.
struct FileCell {
  std::int64_t tag = 0;
  CellKind kind = CellKind::tet;
  std::array<std::int64_t, 8> nodes{};                       // the first corners_of(kind)
  std::optional<std::array<std::int64_t, 6>> midsides = {};  // quadratic tet, in the order of kTetEdges
  // Quadratic cells that are not tets: edges with mid-edge nodes. A node within a face or a hexahedron counts as the
  // middle of each of its diagonals.
  std::vector<FileEdge> edges = {};
  FilePlace place = {};
  int region = 0;  // index into MeshDraft::region_names

  std::span<std::int64_t> corners() { return {nodes.data(), corners_of(kind)}; }
  std::span<const std::int64_t> corners() const { return {nodes.data(), corners_of(kind)}; }

  // Adds the mid-edge nodes of edges, given by places of corners in this cell. Both arguments are in the same order.
  void add_edge_middles(std::span<const std::array<std::size_t, 2>> corners_of_edges,
                        std::span<const std::int64_t> middles);
  // Adds the node within the quadrilateral of these four corners.
  void add_face_middle(const std::array<std::size_t, 4>& places, std::int64_t middle);
  // Adds the node at the centre of a hexahedron.
  void add_centre(std::int64_t middle);

  bool is_quadratic() const { return midsides.has_value() || !edges.empty(); }
};

// A triangle or a quadrilateral.
struct FileFace {
  std::int64_t tag = 0;
  std::array<std::int64_t, 4> nodes{};  // the first `sides`
  std::size_t sides = 3;
  FilePlace place = {};

  std::span<std::int64_t> corners() { return {nodes.data(), sides}; }
  std::span<const std::int64_t> corners() const { return {nodes.data(), sides}; }
};

// A node in a set, and where the set lists it.
struct FileNodeUse {
  std::int64_t tag = 0;
  FilePlace place;
};

struct MeshDraft {
  std::vector<std::string> files;  // the first is the file given by the user
  std::vector<FileNode> nodes;     // in any order
  std::vector<FileCell> cells;
  std::vector<std::string> region_names;
  std::map<std::string, std::vector<FileFace>> surfaces;
  std::map<std::string, std::vector<FileNodeUse>> node_sets;
  std::string nodes_section;  // where nodes are defined, for messages: "$Nodes"
  Warnings warnings;
  std::map<std::string, int> region_indices;  // used by region_index()

  // The index of the region of this name; adds it if it is new.
  int region_index(const std::string& name);

  std::string where(FilePlace place) const;  // "beam.msh:120", or "beam.vtu"

  // Throws ConfigError "where(place): message".
  template <class... Args>
  [[noreturn]] void fail(FilePlace place, fmt::format_string<Args...> message, Args&&... args) const {
    throw ConfigError(where(place), fmt::format(message, std::forward<Args>(args)...));
  }
  // Adds the warning "where(place): message"; {} is the first file as a whole.
  template <class... Args>
  void warn(FilePlace place, fmt::format_string<Args...> message, Args&&... args) {
    warnings.push_back(where(place) + ": " + fmt::format(message, std::forward<Args>(args)...));
  }
};

// Numbers nodes by ascending tag; elements keep their order. Splits hexahedra, wedges and pyramids into tetrahedra
// (split_cells.h), quadratic ones into quadratic tetrahedra of the same curved shape (split_middles.h), or keeps them
// (FileCells, whole_cells.h). Reorients elements that are inverted as a whole. Warns of split and of reoriented
// elements, and if splitting changes the volume. Throws ConfigError for undefined tags, tags that are defined twice, a
// mesh without elements, linear beside quadratic elements, a tet on a quadrilateral that does not match its diagonal,
// and a mesh that validate() refuses.
LoadedMesh build_mesh(MeshDraft draft, FileCells cells = FileCells::keep);

}  // namespace orthodyn
