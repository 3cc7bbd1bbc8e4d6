#include "lib/material_axes/axes_rows.h"

#include <filesystem>

#include "lib/config/csv_table.h"
#include "lib/core/errors.h"
#include "lib/core/file_kind.h"
#include "lib/mesh/io/mesh_file.h"

namespace orthodyn {

namespace {

const std::vector<std::string> kFirstTwo{"a1x", "a1y", "a1z", "a2x", "a2y", "a2z"};
const std::vector<std::string> kThird{"a3x", "a3y", "a3z"};

AxesRows read_axes_csv(const FilePath& file) {
  auto optional = kThird;
  optional.insert(optional.begin(), "element");
  const CsvTable table = read_csv(file, kFirstTwo, optional);
  const bool third = table.has(kThird[0]) || table.has(kThird[1]) || table.has(kThird[2]);
  std::vector<std::size_t> columns;
  for (const auto& name : kFirstTwo) columns.push_back(table.column(name));
  if (third)
    for (const auto& name : kThird) {
      if (!table.has(name)) throw ConfigError(file.path, "axis 3 needs all of " + join(kThird, ","));
      columns.push_back(table.column(name));
    }
  AxesRows out{{}, third, !table.has("element"), file.path, {}};
  for (std::size_t k = 0; k < table.rows(); ++k) {
    const int element = out.one_per_element ? static_cast<int>(k) : table.index(k, "element");
    Mat3 m = Mat3::Zero();
    for (std::size_t i = 0; i < columns.size(); ++i) m(static_cast<Eigen::Index>(i)) = table.at(k, columns[i]);
    out.rows.push_back({element, m, table.lines[k]});
  }
  return out;
}

// The three components of an axis in the cell data of a mesh.
struct Components {
  const CellData* data = nullptr;
  std::size_t first = 0;

  Vec3 of(std::size_t cell) const {
    return Eigen::Map<const Vec3>(&data->values[cell * static_cast<std::size_t>(data->components) + first]);
  }
};

std::vector<Components> axes_of(const LoadedMesh& loaded, const std::string& path) {
  std::vector<Components> axes;
  if (const CellData* all = find_cell_data(loaded, "axes"); all && all->components == 9) {
    for (const std::size_t k : {0u, 1u, 2u}) axes.push_back({all, 3 * k});
    return axes;
  }
  for (const char* name : {"axis_1", "axis_2", "axis_3"})
    if (const CellData* one = find_cell_data(loaded, name); one && one->components == 3) axes.push_back({one, 0});
    else break;
  if (axes.size() >= 2) return axes;
  std::vector<std::string> names;
  for (const auto& data : loaded.cell_data) names.push_back(fmt::format("{} ({})", data.name, data.components));
  throw ConfigError(path, fmt::format("expected cell data axis_1, axis_2 (3 components each) or axes (9), found {}",
                                      names.empty() ? "none" : join(names)));
}

AxesRows read_axes_mesh(const FilePath& file, FileCells cells) {
  LoadedMesh loaded = read_mesh(file.path, cells);
  const auto axes = axes_of(loaded, file.path);
  AxesRows out{{}, axes.size() == 3, true, file.path, {}};
  for (std::size_t e = 0; e < loaded.mesh.cells.size(); ++e) {
    Mat3 m = Mat3::Zero();
    for (std::size_t i = 0; i < axes.size(); ++i) m.col(static_cast<Eigen::Index>(i)) = axes[i].of(e);
    const int cell = loaded.mesh.cell_of.empty() ? static_cast<int>(e) : loaded.mesh.cell_of[e];
    if (!m.allFinite()) throw ConfigError(file.path, fmt::format("cell {}: an axis is not a finite number", cell));
    out.rows.push_back({static_cast<int>(e), m, cell});
  }
  out.mesh = std::move(loaded.mesh);
  return out;
}

}  // namespace

AxesRows read_axes_rows(const FilePath& file, FileCells cells) {
  const std::string extension = std::filesystem::path(file.path).extension().string();
  if (!is_file(file.path)) throw ConfigError(file.where, "no such file: " + file.path);
  if (extension == ".csv") return read_axes_csv(file);
  if (extension == ".vtu" || extension == ".inp") return read_axes_mesh(file, cells);
  throw ConfigError(file.where,
                    fmt::format("axes cannot be read from a file of type '{}'; known: .csv, .vtu, .inp", extension));
}

}  // namespace orthodyn
