#include "lib/mesh/io/vtk_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <utility>

#include "lib/core/errors.h"
#include "lib/core/parse_number.h"
#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/mesh_draft.h"

namespace orthodyn {
namespace {

[[noreturn]] void fail(const VtkGrid& grid, const std::string& message) {
  throw ConfigError(grid.path, message);
}

std::string name_of_type(int type) {
  static const std::map<int, const char*> names{
      {6, "triangle strip"},       {7, "polygon"},           {8, "pixel"},         {9, "quadrangle"},
      {11, "voxel"},               {12, "hexahedron"},       {13, "wedge"},        {14, "pyramid"},
      {23, "quadratic quad"}, {25, "quadratic hexahedron"},
      {42, "polyhedron"},          {71, "Lagrange tet"}};
  const auto found = names.find(type);
  return found == names.end() ? fmt::format("cell type {}", type) : fmt::format("{} (type {})", found->second, type);
}

// An integer in [low, high].
std::int64_t whole(const VtkGrid& grid, double x, double low, double high, const std::string& what) {
  if (x >= low && x <= high && x == std::floor(x)) return static_cast<std::int64_t>(x);
  fail(grid, fmt::format("{} is {}; expected an integer from {} to {}", what, x, low, high));
}

void check_sizes(const VtkGrid& grid) {
  if (grid.points.size() % 3 != 0)
    fail(grid, fmt::format("{} coordinates are not three per point", grid.points.size()));
  if (grid.types.size() != grid.offsets.size()) {
    fail(grid, fmt::format("{} types and {} offsets for the same cells", grid.types.size(), grid.offsets.size()));
  }
  const auto check = [&](const std::vector<CellData>& arrays, std::size_t tuples, const char* what) {
    for (const CellData& data : arrays) {
      if (data.components >= 1 && data.values.size() == tuples * static_cast<std::size_t>(data.components)) continue;
      fail(grid, fmt::format("array \"{}\" has {} values; expected {} {} with {} components", data.name,
                             data.values.size(), tuples, what, data.components));
    }
  };
  check(grid.cell_data, grid.types.size(), "cells");
  check(grid.point_data, grid.points.size() / 3, "points");
}

int points_of_tet(double type) { return type == kVtkTetra ? 4 : 10; }

// The cells that are tets; the others are counted or refused.
std::vector<std::size_t> select_tets(const VtkGrid& grid, MeshDraft& draft) {
  std::vector<std::size_t> tets;
  double begin = 0;
  for (std::size_t c = 0; c < grid.types.size(); ++c) {
    const auto size = static_cast<double>(grid.connectivity.size());
    const double end =
        static_cast<double>(whole(grid, grid.offsets[c], begin, size, fmt::format("the offset of cell {}", c)));
    const int type = static_cast<int>(whole(grid, grid.types[c], 0, 255, fmt::format("the type of cell {}", c)));
    if (type == kVtkTetra || type == kVtkQuadraticTetra) {
      if (end - begin != points_of_tet(type))
        fail(grid, fmt::format("cell {}: a tetrahedron (type {}) of {} points; expected {}", c, type, end - begin,
                               points_of_tet(type)));
      tets.push_back(c);
    } else if (type > 5 && type != 21 && type != 22) {
      fail(grid, fmt::format("cell {}: a {}; only linear and quadratic tetrahedra (10, 24) are read, with vertices, "
                             "lines and triangles beside them: mesh again, or cut the cells (ParaView: Tetrahedralize)",
                             c, name_of_type(type)));
    }
    begin = end;
  }
  if (begin != static_cast<double>(grid.connectivity.size())) {
    fail(grid, fmt::format("connectivity has {} entries, but the cells end at {}", grid.connectivity.size(), begin));
  }
  if (tets.empty()) fail(grid, "no tetrahedra (cell type 10 or 24)");
  if (tets.size() < grid.types.size()) {
    draft.warnings.push_back(fmt::format("{}: {} vertices, lines and triangles are ignored", grid.path,
                                         grid.types.size() - tets.size()));
  }
  return tets;
}

void add_nodes_and_tets(const VtkGrid& grid, const std::vector<std::size_t>& tets, MeshDraft& draft) {
  const std::size_t points = grid.points.size() / 3;
  for (std::size_t p = 0; p < points; ++p) {
    draft.nodes.push_back(
        {static_cast<std::int64_t>(p), {}, Vec3(grid.points[3 * p], grid.points[3 * p + 1], grid.points[3 * p + 2])});
  }
  for (const std::size_t c : tets) {
    FileTet tet;
    tet.tag = static_cast<std::int64_t>(c);
    auto next = static_cast<std::size_t>(grid.offsets[c]) - static_cast<std::size_t>(points_of_tet(grid.types[c]));
    const auto read = [&](auto& nodes) {
      for (std::int64_t& node : nodes)
        node = whole(grid, grid.connectivity[next++], 0, static_cast<double>(points) - 1,
                     fmt::format("element {}: a point", c));
    };
    read(tet.nodes);
    if (grid.types[c] == kVtkQuadraticTetra) read(tet.midsides.emplace());
    draft.tets.push_back(tet);
  }
}

const CellData* region_data(const VtkGrid& grid) {
  for (const char* name : {"region", "gmsh:physical"}) {
    for (const CellData& data : grid.cell_data) {
      if (data.name == name && data.components == 1) return &data;
    }
  }
  return nullptr;
}

void add_regions(const VtkGrid& grid, const std::vector<std::size_t>& tets, MeshDraft& draft) {
  const CellData* data = region_data(grid);
  if (!data) {
    draft.region_names = {"body"};
    return;
  }
  std::map<std::int64_t, int> index;
  for (const std::size_t c : tets) {
    index[whole(grid, data->values[c], -1e9, 1e9, fmt::format("cell data \"{}\" of cell {}", data->name, c))] = 0;
  }
  for (auto& [number, region] : index) {
    const bool named = number >= 0 && number < static_cast<std::int64_t>(grid.region_names.size());
    region = draft.region_index(named ? grid.region_names[static_cast<std::size_t>(number)]
                                      : fmt::format("region{}", number));
  }
  for (std::size_t t = 0; t < tets.size(); ++t) {
    draft.tets[t].region = index.at(static_cast<std::int64_t>(data->values[tets[t]]));
  }
}

void add_node_sets(const VtkGrid& grid, MeshDraft& draft) {
  const std::string prefix = "nodes:";
  for (const CellData& data : grid.point_data) {
    if (!data.name.starts_with(prefix) || data.components != 1) continue;
    auto& set = draft.node_sets[data.name.substr(prefix.size())];
    for (std::size_t p = 0; p < data.values.size(); ++p) {
      if (data.values[p] != 0) set.push_back({static_cast<std::int64_t>(p), {}});
    }
  }
}

std::vector<CellData> data_of_tets(std::vector<CellData> all, const std::vector<std::size_t>& tets) {
  for (CellData& data : all) {
    const auto components = static_cast<std::size_t>(data.components);
    for (std::size_t t = 0; t < tets.size(); ++t) {  // tets[t] >= t: moves towards the front
      for (std::size_t k = 0; k < components; ++k)
        data.values[components * t + k] = data.values[components * tets[t] + k];
    }
    data.values.resize(components * tets.size());
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
      {"Int8", {'i', 1}},    {"UInt8", {'u', 1}},          {"Int16", {'i', 2}},         {"UInt16", {'u', 2}},
      {"Int32", {'i', 4}},   {"UInt32", {'u', 4}},         {"Int64", {'i', 8}},         {"UInt64", {'u', 8}},
      {"Float32", {'f', 4}}, {"Float64", {'f', 8}},        {"String", {'i', 1}},        {"char", {'i', 1}},
      {"unsigned_char", {'u', 1}}, {"short", {'i', 2}},    {"unsigned_short", {'u', 2}}, {"int", {'i', 4}},
      {"unsigned_int", {'u', 4}},  {"long", {'i', 8}},     {"unsigned_long", {'u', 8}}, {"float", {'f', 4}},
      {"double", {'f', 8}},  {"vtktypeint64", {'i', 8}},   {"vtktypeint32", {'i', 4}},  {"vtkIdType", {'i', 4}},
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

LoadedMesh build_vtk_mesh(VtkGrid grid) {
  check_sizes(grid);
  MeshDraft draft;
  draft.files = {grid.path};
  draft.nodes_section = "Points";
  const std::vector<std::size_t> tets = select_tets(grid, draft);
  add_nodes_and_tets(grid, tets, draft);
  add_regions(grid, tets, draft);
  add_node_sets(grid, draft);
  LoadedMesh loaded = build_mesh(std::move(draft));
  loaded.cell_data = data_of_tets(std::move(grid.cell_data), tets);
  return loaded;
}

}  // namespace orthodyn
