#include "lib/material/fibres/curve_points.h"

#include <fmt/format.h>

#include "lib/config/csv_table.h"

namespace orthodyn {

namespace {

constexpr const char *kStretch = "stretch", *kStrain = "strain";

struct Table {
  std::vector<MonotoneCubic::Point> points;
  std::vector<std::string> places;  // of points, for messages
};

Table table_of(const FilePath& file, const std::string& x, const std::string& y) {
  const CsvTable csv = x == kStretch ? read_csv(file, {y}, {kStretch, kStrain}) : read_csv(file, {x, y});
  const bool has_strain = csv.has(kStrain);
  if (csv.has(x) == has_strain)
    throw ConfigError(file.path, "needs either the column 'stretch' or the column 'strain'");
  Table table;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const double first = has_strain ? 1 + csv.at(row, csv.column(kStrain)) : csv.at(row, csv.column(x));
    table.points.push_back({first, csv.at(row, csv.column(y))});
    table.places.push_back(csv.where(row));
  }
  return table;
}

Table table_of(const CurvePoints& given) {
  Table table{given.points, {}};
  for (std::size_t i = 0; i < given.points.size(); ++i)
    table.places.push_back(fmt::format("{}.points[{}]", given.origin.where, i));
  return table;
}

Table checked_table(const CurvePoints& given, const std::string& x, const std::string& y) {
  if (given.points.empty() != given.file.has_value())
    given.origin.fail(fmt::format("give one of points and file; {}",
                                  given.file ? "the section has both" : "the section has neither, or no points"));
  Table table = given.file ? table_of(*given.file, x, y) : table_of(given);
  const auto& points = table.points;
  if (points.size() < 2)
    throw ConfigError(given.file ? given.file->path : given.origin.where, "has one point; a curve needs at least two");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i][1] < 0) throw ConfigError(table.places[i], fmt::format("the {} {:.6g} is negative", y, points[i][1]));
    if (i > 0 && !(points[i][0] > points[i - 1][0]))
      throw ConfigError(table.places[i],
                        fmt::format("the {} {:.6g} does not exceed that of the point before, {:.6g}; sort the points, "
                                    "and give each {} once",
                                    x, points[i][0], points[i - 1][0], x));
  }
  return table;
}

}  // namespace

std::vector<MonotoneCubic::Point> CurvePoints::read(const std::string& x, const std::string& y) const {
  return checked_table(*this, x, y).points;
}

std::vector<MonotoneCubic::Point> CurvePoints::read_ascending(const std::string& x, const std::string& y) const {
  const Table table = checked_table(*this, x, y);
  for (std::size_t i = 1; i < table.points.size(); ++i)
    if (table.points[i][1] < table.points[i - 1][1])
      throw ConfigError(table.places[i],
                        fmt::format("the {} falls from {:.6g} to {:.6g}, but must not decrease; smooth the data", y,
                                    table.points[i - 1][1], table.points[i][1]));
  return table.points;
}

}  // namespace orthodyn
