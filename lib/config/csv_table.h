// A table of numbers from a CSV file: a line of column names, then rows of numbers.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "lib/config/values.h"

namespace orthodyn {

struct CsvTable {
  std::string path;
  std::vector<std::string> names;
  std::vector<double> values;  // row by row
  std::vector<int> lines;      // line number of each row

  std::size_t rows() const { return lines.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * names.size() + column]; }
  bool has(const std::string& name) const;
  std::size_t column(const std::string& name) const;  // precondition: has(name)
  // The entry as the index of a node or an element. Throws ConfigError unless it is an integer from 0 to 2e9.
  int index(std::size_t row, const std::string& name) const;
  std::string where(std::size_t row) const { return fmt::format("{}:{}", path, lines[row]); }
};

// Reads a file that has all `required` columns and any of the `optional` ones, in any order. Commas separate entries;
// empty lines and lines that start with # are skipped. Throws ConfigError "file:line: ..." for an unknown, missing or
// repeated column name, a row with too few or too many entries, and an entry that is not a finite number. Throws
// "<file.where>: ..." if the file does not exist, cannot be read or has no rows.
CsvTable read_csv(const FilePath& file, const std::vector<std::string>& required,
                  const std::vector<std::string>& optional = {});

// Reads a file with any columns. Empty entries, "nan" and "NaN" are NaN. Otherwise as read_csv().
CsvTable read_csv_with_gaps(const FilePath& file);

}  // namespace orthodyn
