#include "lib/scene/axes/axes_rows.h"

#include <cmath>
#include <filesystem>

#include "lib/core/errors.h"
#include "lib/scene/axes/csv_table.h"

namespace orthodyn {

namespace {

const std::vector<std::string> kFirstTwo{"a1x", "a1y", "a1z", "a2x", "a2y", "a2z"};
const std::vector<std::string> kThird{"a3x", "a3y", "a3z"};

int element_index(const CsvTable& table, std::size_t row, std::size_t column) {
  const double given = table.at(row, column);
  if (given != std::floor(given) || given < 0 || given > 2e9)
    throw ConfigError(fmt::format("{}: column element: expected a whole number from 0, found {}", table.where(row), given));
  return static_cast<int>(given);
}

AxesRows read_axes_csv(const FilePath& file) {
  auto optional = kThird;
  optional.insert(optional.begin(), "element");
  const CsvTable table = read_csv(file, kFirstTwo, optional);
  const bool third = table.has(kThird[0]) || table.has(kThird[1]) || table.has(kThird[2]);
  std::vector<std::size_t> columns;
  for (const auto& name : kFirstTwo) columns.push_back(table.column(name));
  if (third)
    for (const auto& name : kThird) {
      if (!table.has(name)) throw ConfigError(file.path + ": axis 3 needs all of " + join(kThird, ","));
      columns.push_back(table.column(name));
    }
  AxesRows out{{}, third, !table.has("element"), file.path};
  for (std::size_t k = 0; k < table.rows(); ++k) {
    const int element = out.every ? static_cast<int>(k) : element_index(table, k, table.column("element"));
    Mat3 m = Mat3::Zero();
    for (std::size_t i = 0; i < columns.size(); ++i) m(static_cast<Eigen::Index>(i)) = table.at(k, columns[i]);
    out.rows.push_back({element, m, table.lines[k]});
  }
  return out;
}

}  // namespace

AxesRows read_axes_rows(const FilePath& file) {
  const std::string extension = std::filesystem::path(file.path).extension().string();
  if (extension == ".csv") return read_axes_csv(file);
  throw ConfigError(fmt::format("{}: '{}' is not a kind of file that axes are read from; known: .csv", file.where, extension));
}

}  // namespace orthodyn
