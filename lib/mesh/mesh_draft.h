// What a mesh file says, before it becomes a TetMesh: numbers of the file instead of indices, and
// the place of everything. Filled by the readers of the formats.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/core/types.h"
#include "lib/mesh/cell_kind.h"
#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

struct FilePlace {
  int line = 0;  // 0: in a file without lines, the number is enough
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

// A solid element, with its corners in the order of cell_kind.h.
struct FileCell {
  std::int64_t tag = 0;
  CellKind kind = CellKind::tet;
  std::array<std::int64_t, 8> nodes{};                       // the first corners_of(kind)
  std::optional<std::array<std::int64_t, 6>> midsides = {};  // of a quadratic tet, in the order of kTetEdges
  // Of another one of second order: with their middle nodes. A node within a face, or within a hexahedron, is the
  // middle of diagonals.
  std::vector<FileEdge> edges = {};
  FilePlace place = {};
  int region = 0;  // index into MeshDraft::region_names

  std::span<std::int64_t> corners() { return {nodes.data(), corners_of(kind)}; }
  std::span<const std::int64_t> corners() const { return {nodes.data(), corners_of(kind)}; }

  // The node within the quadrilateral of these four places of corners.
  void add_face_middle(const std::array<std::size_t, 4>& places, std::int64_t middle);
  void add_centre(std::int64_t middle);  // of a hexahedron

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

// A node that a set names.
struct FileNodeUse {
  std::int64_t tag = 0;
  FilePlace place;
};

struct MeshDraft {
  std::vector<std::string> files;  // the first is the one that the user named
  std::vector<FileNode> nodes;     // in any order
  std::vector<FileCell> cells;
  std::vector<std::string> region_names;
  std::map<std::string, std::vector<FileFace>> surfaces;
  std::map<std::string, std::vector<FileNodeUse>> node_sets;
  std::string nodes_section;  // what defines nodes, for messages: "$Nodes"
  Warnings warnings;
  std::map<std::string, int> region_indices;  // of region_index()

  // The index of the region of this name, which is added if it is new.
  int region_index(const std::string& name);

  std::string where(FilePlace place) const;  // "beam.msh:120", or "beam.vtu"
  [[noreturn]] void fail(FilePlace place, const std::string& message) const;
};

// Nodes are numbered by ascending tag; elements keep their order. Hexahedra, wedges and pyramids are split into
// tetrahedra (split_cells.h), which is said; a tet on a quadrilateral must fit its diagonal. Those of second
// order become quadratic tetrahedra of the same curved shape (split_middles.h); a volume that is another one than by
// the elements' own shape functions is told. Linear and quadratic elements do not mix. Elements that are inverted as a
// whole count their nodes the other way round: they are turned, with a warning; what then overlaps is refused. Throws
// ConfigError for tags that are not defined or defined twice, for a mesh without elements, and for what validate()
// refuses.
LoadedMesh build_mesh(MeshDraft draft);

}  // namespace orthodyn
