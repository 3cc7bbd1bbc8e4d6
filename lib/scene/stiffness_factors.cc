#include "lib/scene/stiffness_factors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "lib/config/csv_table.h"

namespace orthodyn {

namespace {

constexpr long kMostCells = 100000;

long size_of(const std::array<int, 3>& grid) { return static_cast<long>(grid[0]) * grid[1] * grid[2]; }

// Cell (i, j, k), counted from 0.
int number_of(const std::array<int, 3>& grid, const std::array<int, 3>& at) {
  return at[0] + grid[0] * (at[1] + grid[1] * at[2]);
}

std::array<int, 3> place_of(const std::array<int, 3>& grid, int cell) {
  return {cell % grid[0], cell / grid[0] % grid[1], cell / (grid[0] * grid[1])};
}

// Reads columns i, j, k (from 1) and factor; the other columns are those that a fit writes.
std::vector<double> read_factors(const FilePath& file, const std::array<int, 3>& grid) {
  const CsvTable table = read_csv_with_gaps(file);
  for (const char* name : {"i", "j", "k", "factor"})
    if (!table.has(name)) throw ConfigError(file.path, fmt::format("has no column '{}'", name));
  std::vector<double> values(static_cast<std::size_t>(size_of(grid)), 0);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::array<int, 3> at{};
    for (std::size_t a = 0; a < 3; ++a) {
      const std::string name(1, static_cast<char>('i' + a));
      at[a] = table.index(row, name) - 1;
      if (at[a] < 0 || at[a] >= grid[a])
        throw ConfigError(table.where(row), fmt::format("{} is {}; the grid has 1 to {}", name, at[a] + 1, grid[a]));
    }
    double& value = values[static_cast<std::size_t>(number_of(grid, at))];
    if (value != 0) throw ConfigError(table.where(row), "has a second factor for the same cell");
    value = table.at(row, table.column("factor"));
    if (!(value > 0)) throw ConfigError(table.where(row), fmt::format("the factor {} is not positive", value));
  }
  if (const auto missing = std::ranges::find(values, 0.0); missing != values.end()) {
    const auto at = place_of(grid, static_cast<int>(missing - values.begin()));
    throw ConfigError(file.path, fmt::format("has no factor for the cell {}, {}, {} of the grid {}", at[0] + 1,
                                             at[1] + 1, at[2] + 1, fmt::join(grid, " x ")));
  }
  return values;
}

void check_factors(const StiffnessFactors& factors, const Config& config) {
  const long cells = size_of(factors.grid);
  if (cells > kMostCells)
    config.at("grid").fail(fmt::format("has {} cells; at most {} are allowed", cells, kMostCells));
  if (factors.file) {
    if (factors.values) config.at("values").fail("has no effect beside 'file'; remove one of them");
    factors.all();
  } else if (!factors.values) {
    config.fill("values", fmt::format("[{}]", fmt::join(std::vector<int>(static_cast<std::size_t>(cells), 1), ", ")));
  } else if (std::ssize(*factors.values) != cells) {
    config.at("values").fail(
        fmt::format("has {} factors, and the grid has {} cells ({}); leave 'values' out for "
                    "factors of 1",
                    factors.values->size(), cells, fmt::join(factors.grid, " x ")));
  }
}

}  // namespace

const Spec<StiffnessFactors>& StiffnessFactors::spec() {
  static const auto s =
      Spec<StiffnessFactors>()
          .key(
              "grid", &StiffnessFactors::grid,
              "Number of cells of the grid along x, y and z. The grid fills the bounding box of the region at rest; an "
              "element belongs to the cell in which its centroid lies.",
              {.required = true, .range = {1, kMostCells}})
          .key("values", &StiffnessFactors::values,
               "A factor for each cell, first along x, then y, then z; default 1 for each.", {.range = kPositive})
          .key(
              "file", &StiffnessFactors::file,
              "Instead of `values`: a CSV file with the columns i, j, k (numbers of the cell along x, y and z, from 1) "
              "and factor, such as a fit writes.")
          .check(check_factors);
  return s;
}

std::vector<double> StiffnessFactors::all() const {
  if (file) return read_factors(*file, grid);
  return values ? *values : std::vector<double>(static_cast<std::size_t>(size_of(grid)), 1);
}

int StiffnessFactors::cell_at(const Vec3& point, const Box& box) const {
  std::array<int, 3> at{};
  for (int a = 0; a < 3; ++a) {
    const auto index = static_cast<std::size_t>(a);
    const double size = box.size()[a], share = size > 0 ? (point[a] - box.min[a]) / size : 0;
    at[index] = std::clamp(static_cast<int>(std::floor(share * grid[index])), 0, grid[index] - 1);
  }
  return number_of(grid, at);
}

Vec3 StiffnessFactors::centre(int cell, const Box& box) const {
  const auto at = place_of(grid, cell);
  Vec3 out;
  for (int a = 0; a < 3; ++a) {
    const auto index = static_cast<std::size_t>(a);
    out[a] = box.min[a] + box.size()[a] * (at[index] + 0.5) / grid[index];
  }
  return out;
}

std::vector<int> StiffnessFactors::neighbours(int cell) const {
  std::vector<int> out;
  for (std::size_t a = 0; a < 3; ++a) {
    auto at = place_of(grid, cell);
    if (++at[a] < grid[a]) out.push_back(number_of(grid, at));
  }
  return out;
}

}  // namespace orthodyn
