#include "lib/mesh/io/vtk_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "lib/core/errors.h"
#include "lib/core/parse_number.h"
#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/mesh_draft.h"
#include "lib/mesh/split_cells.h"

namespace orthodyn {
namespace {

template <class... Args>
[[noreturn]] void fail(const VtkGrid& grid, fmt::format_string<Args...> message, Args&&... args) {
  throw ConfigError(grid.path, fmt::format(message, std::forward<Args>(args)...));
}

std::string name_of_type(int type) {
  static const std::map<int, const char*> names{
      {6, "triangle strip"}, {7, "polygon"}, {42, "polyhedron"}, {71, "Lagrange tet"}, {72, "Lagrange hexahedron"}};
  const auto found = names.find(type);
  return found == names.end() ? fmt::format("cell type {}", type) : fmt::format("{} (type {})", found->second, type);
}

// An integer in [low, high].
std::int64_t whole(const VtkGrid& grid, double x, double low, double high, const std::string& what) {
  if (x >= low && x <= high && x == std::floor(x)) return static_cast<std::int64_t>(x);
  fail(grid, "{} is {}; expected an integer from {} to {}", what, x, low, high);
}

void check_sizes(const VtkGrid& grid) {
  if (grid.points.size() % 3 != 0) fail(grid, "{} coordinates are not three per point", grid.points.size());
  if (grid.types.size() != grid.offsets.size())
    fail(grid, "{} cell types, but {} cell offsets; there must be one of each per cell", grid.types.size(),
         grid.offsets.size());
  const auto check = [&](const std::vector<CellData>& arrays, std::size_t tuples, const char* what) {
    for (const CellData& data : arrays) {
      if (data.components >= 1 && data.values.size() == tuples * static_cast<std::size_t>(data.components)) continue;
      fail(grid, "array \"{}\" has {} values; expected {} {} with {} components", data.name, data.values.size(), tuples,
           what, data.components);
    }
  };
  check(grid.cell_data, grid.types.size(), "cells");
  check(grid.point_data, grid.points.size() / 3, "points");
}

// A solid cell type of vtkCellType.h.
struct VtkSolid {
  CellKind kind;
  std::size_t points;
  CornerIndices corners;                               // in the order of cell_kind.h
  std::vector<std::array<std::size_t, 4>> faces = {};  // faces with a centre node
};

const VtkSolid* solid_of(double type) {
  static const CornerIndices four{0, 1, 2, 3}, five{0, 1, 2, 3, 4}, six{0, 1, 2, 3, 4, 5},
      eight{0, 1, 2, 3, 4, 5, 6, 7};
  static const std::map<double, VtkSolid> solids{
      {kVtkTetra, {CellKind::tet, 4, four}},
      {kVtkQuadraticTetra, {CellKind::tet, 10, four}},
      {11, {CellKind::hexahedron, 8, {0, 1, 3, 2, 4, 5, 7, 6}}},  // voxel
      {12, {CellKind::hexahedron, 8, eight}},
      {13, {CellKind::wedge, 6, six}},
      {14, {CellKind::pyramid, 5, five}},
      {25, {CellKind::hexahedron, 20, eight}},
      {26, {CellKind::wedge, 15, six}},
      {27, {CellKind::pyramid, 13, five}},
      {29,
       {CellKind::hexahedron,
        27,
        eight,
        {{0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 2, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}}}},
      {32, {CellKind::wedge, 18, six, {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}}}};
  const auto found = solids.find(type);
  return found == solids.end() ? nullptr : &found->second;
}

// Vertices, lines, triangles and quadrilaterals of first and second order, which are ignored.
bool is_flat(int type) {
  static const std::set<int> flat{0, 1, 2, 3, 4, 5, 8, 9, 21, 22, 23, 28};
  return flat.contains(type);
}

// Indices of the solid cells. Fails for unsupported ones, warns of ignored ones.
std::vector<std::size_t> select_solids(const VtkGrid& grid, MeshDraft& draft) {
  std::vector<std::size_t> solids;
  double begin = 0;
  for (std::size_t c = 0; c < grid.types.size(); ++c) {
    const auto size = static_cast<double>(grid.connectivity.size());
    const double end =
        static_cast<double>(whole(grid, grid.offsets[c], begin, size, fmt::format("the offset of cell {}", c)));
    const int type = static_cast<int>(whole(grid, grid.types[c], 0, 255, fmt::format("the type of cell {}", c)));
    if (const VtkSolid* solid = solid_of(type)) {
      if (end - begin != static_cast<double>(solid->points))
        fail(grid, "cell {}: a {} (type {}) of {} points; expected {}", c, name_of(solid->kind), type, end - begin,
             solid->points);
      solids.push_back(c);
    } else if (!is_flat(type)) {
      fail(grid,
           "cell {}: a {}; only tetrahedra, hexahedra, wedges and pyramids of first or second order are read, with "
           "vertices, lines and faces beside them: mesh again, or cut the cells (ParaView: Tetrahedralize)",
           c, name_of_type(type));
    }
    begin = end;
  }
  if (begin != static_cast<double>(grid.connectivity.size()))
    fail(grid, "connectivity has {} entries, but the cells end at {}", grid.connectivity.size(), begin);
  if (solids.empty()) {
    const bool has_faces = std::any_of(grid.types.begin(), grid.types.end(),
                                       [](double type) { return type == 5 || type == 9 || type == 22 || type == 23; });
    fail(grid,

         "no solid cells (tetrahedra are cell type 10 or 24, hexahedra 12, 25 or 29, wedges 13, 26 or 32){}",
         has_faces ? ": triangles and quadrilaterals alone are a 2D mesh or a surface; mesh the volume inside" : "");
  }
  if (solids.size() < grid.types.size())
    draft.warn({}, "{} vertices, lines, triangles and quadrilaterals are ignored", grid.types.size() - solids.size());
  return solids;
}

// The normal of a wedge's base points outward in VTK's manual, but inward in some files (Gmsh 4.8: outward in first
// order, inward in second). The coordinates decide.
void orient_wedge(FileCell& cell, const std::vector<FileNode>& nodes) {
  const auto x = [&](std::size_t k) -> const Vec3& { return nodes[static_cast<std::size_t>(cell.nodes[k])].x; };
  const Vec3 normal = (x(1) - x(0)).cross(x(2) - x(0)) + (x(4) - x(3)).cross(x(5) - x(3));
  if (normal.dot(x(3) + x(4) + x(5) - x(0) - x(1) - x(2)) >= 0) return;
  for (std::size_t k = 0; k < 3; ++k) std::swap(cell.nodes[k], cell.nodes[k + 3]);
}

void add_nodes_and_cells(const VtkGrid& grid, const std::vector<std::size_t>& solids, MeshDraft& draft) {
  const std::size_t points = grid.points.size() / 3;
  for (std::size_t p = 0; p < points; ++p)
    draft.nodes.push_back(
        {static_cast<std::int64_t>(p), {}, Vec3(grid.points[3 * p], grid.points[3 * p + 1], grid.points[3 * p + 2])});
  for (const std::size_t c : solids) {
    const VtkSolid& solid = *solid_of(grid.types[c]);
    FileCell cell{.tag = static_cast<std::int64_t>(c), .kind = solid.kind};
    const std::size_t first = static_cast<std::size_t>(grid.offsets[c]) - solid.points;
    const auto point = [&](std::size_t k) {
      return whole(grid, grid.connectivity[first + k], 0, static_cast<double>(points) - 1,
                   fmt::format("element {}: a point", c));
    };
    for (std::size_t k = 0; k < solid.corners.size(); ++k) cell.nodes[k] = point(solid.corners[k]);
    if (grid.types[c] == kVtkQuadraticTetra) {
      cell.midsides.emplace();
      for (std::size_t k = 0; k < 6; ++k) (*cell.midsides)[k] = point(4 + k);
    } else if (solid.points > solid.corners.size()) {
      const auto& edges = edges_of(cell.kind);
      std::vector<std::int64_t> middles;
      for (std::size_t e = 0; e < edges.size(); ++e) middles.push_back(point(solid.corners.size() + e));
      cell.add_edge_middles(edges, middles);
      const std::size_t behind = solid.corners.size() + edges.size();
      for (std::size_t f = 0; f < solid.faces.size() && behind + f < solid.points; ++f)
        cell.add_face_middle(solid.faces[f], point(behind + f));
      if (behind + solid.faces.size() < solid.points) cell.add_centre(point(solid.points - 1));
    }
    if (cell.kind == CellKind::wedge) orient_wedge(cell, draft.nodes);
    draft.cells.push_back(cell);
  }
}

const CellData* region_data(const VtkGrid& grid) {
  for (const char* name : {"region", "gmsh:physical"})
    for (const CellData& data : grid.cell_data)
      if (data.name == name && data.components == 1) return &data;
  return nullptr;
}

void add_regions(const VtkGrid& grid, const std::vector<std::size_t>& solids, MeshDraft& draft) {
  const CellData* data = region_data(grid);
  if (!data) {
    draft.region_names = {"body"};
    return;
  }
  std::map<std::int64_t, int> index;
  for (const std::size_t c : solids)
    index[whole(grid, data->values[c], -1e9, 1e9, fmt::format("cell data \"{}\" of cell {}", data->name, c))] = 0;
  for (auto& [number, region] : index) {
    const bool named = number >= 0 && number < static_cast<std::int64_t>(grid.region_names.size());
    region = draft.region_index(named ? grid.region_names[static_cast<std::size_t>(number)]
                                      : fmt::format("region{}", number));
  }
  for (std::size_t k = 0; k < solids.size(); ++k)
    draft.cells[k].region = index.at(static_cast<std::int64_t>(data->values[solids[k]]));
}

void add_node_sets(const VtkGrid& grid, MeshDraft& draft) {
  const std::string prefix = "nodes:";
  for (const CellData& data : grid.point_data) {
    if (!data.name.starts_with(prefix) || data.components != 1) continue;
    auto& set = draft.node_sets[data.name.substr(prefix.size())];
    for (std::size_t p = 0; p < data.values.size(); ++p)
      if (data.values[p] != 0) set.push_back({static_cast<std::int64_t>(p), {}});
  }
}

// Each cell gets the values of the cell of the file that it is, or was cut from.
std::vector<CellData> data_of_cells(std::vector<CellData> all, const std::vector<std::size_t>& solids,
                                    const Mesh& mesh) {
  for (CellData& data : all) {
    const auto components = static_cast<std::size_t>(data.components);
    std::vector<double> values;
    values.reserve(components * mesh.cells.size());
    for (std::size_t t = 0; t < mesh.cells.size(); ++t) {
      const std::size_t cell = mesh.cell_of.empty() ? t : static_cast<std::size_t>(mesh.cell_of[t]);
      const auto first = data.values.begin() + static_cast<std::ptrdiff_t>(components * solids[cell]);
      values.insert(values.end(), first, first + data.components);
    }
    data.values = std::move(values);
  }
  return all;
}

template <class T>
std::vector<double> numbers(std::string_view bytes) {
  std::vector<double> out(bytes.size() / sizeof(T));
  for (std::size_t i = 0; i < out.size(); ++i) {
    T value;
    std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
    out[i] = static_cast<double>(value);
  }
  return out;
}

}  // namespace

std::optional<VtkType> vtk_type(std::string_view name) {
  static const std::map<std::string_view, VtkType> types{
      {"Int8", {'i', 1}},          {"UInt8", {'u', 1}},        {"Int16", {'i', 2}},          {"UInt16", {'u', 2}},
      {"Int32", {'i', 4}},         {"UInt32", {'u', 4}},       {"Int64", {'i', 8}},          {"UInt64", {'u', 8}},
      {"Float32", {'f', 4}},       {"Float64", {'f', 8}},      {"String", {'i', 1}},         {"char", {'i', 1}},
      {"unsigned_char", {'u', 1}}, {"short", {'i', 2}},        {"unsigned_short", {'u', 2}}, {"int", {'i', 4}},
      {"unsigned_int", {'u', 4}},  {"long", {'i', 8}},         {"unsigned_long", {'u', 8}},  {"float", {'f', 4}},
      {"double", {'f', 8}},        {"vtktypeint64", {'i', 8}}, {"vtktypeint32", {'i', 4}},   {"vtkIdType", {'i', 4}},
      {"vtktypeuint8", {'u', 1}}};
  const auto found = types.find(name);
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

std::vector<double> vtk_numbers(std::string_view bytes, VtkType type) {
  if (type.kind == 'f') return type.width == 4 ? numbers<float>(bytes) : numbers<double>(bytes);
  const bool is_signed = type.kind == 'i';
  switch (type.width) {
    case 1: return is_signed ? numbers<std::int8_t>(bytes) : numbers<std::uint8_t>(bytes);
    case 2: return is_signed ? numbers<std::int16_t>(bytes) : numbers<std::uint16_t>(bytes);
    case 4: return is_signed ? numbers<std::int32_t>(bytes) : numbers<std::uint32_t>(bytes);
    default: return is_signed ? numbers<std::int64_t>(bytes) : numbers<std::uint64_t>(bytes);
  }
}

std::vector<double> vtk_numbers(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  std::vector<double> out;
  for (std::size_t p = text.find_first_not_of(kBlanks); p != std::string_view::npos;
       p = text.find_first_not_of(kBlanks, p)) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, p), text.size());
    const std::string_view word = text.substr(p, end - p);
    double value = 0;
    if (!parse_number(word, value)) throw std::runtime_error("expected a number, found " + TextTokens::quoted(word));
    out.push_back(value);
    p = end;
  }
  return out;
}

LoadedMesh build_vtk_mesh(VtkGrid grid, FileCells cells) {
  check_sizes(grid);
  MeshDraft draft;
  draft.files = {grid.path};
  draft.nodes_section = "Points";
  const std::vector<std::size_t> solids = select_solids(grid, draft);
  add_nodes_and_cells(grid, solids, draft);
  add_regions(grid, solids, draft);
  add_node_sets(grid, draft);
  LoadedMesh loaded = build_mesh(std::move(draft), cells);
  loaded.cell_data = data_of_cells(std::move(grid.cell_data), solids, loaded.mesh);
  return loaded;
}

}  // namespace orthodyn
