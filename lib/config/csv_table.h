// A table of numbers from a CSV file: a line of column names, then rows with a number for each.
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
  std::vector<int> lines;      // of each row in the file

  std::size_t rows() const { return lines.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * names.size() + column]; }
  bool has(const std::string& name) const;
  std::size_t column(const std::string& name) const;  // which must be there
  // A whole number from 0, as elements and nodes are counted. Throws ConfigError for any other.
  int index(std::size_t row, const std::string& name) const;
  std::string where(std::size_t row) const { return fmt::format("{}:{}", path, lines[row]); }
};

// Reads a file whose columns are all of `required` and any of `optional`, in any order. Separators are
// commas; empty lines and lines that begin with # are left out. Throws ConfigError "file:line: ..." for a
// name that is unknown, missing or there twice, a row with more or fewer entries, and what is no finite
// number; and "<file.where>: ..." if there is no such file or no row.
CsvTable read_csv(const FilePath& file, const std::vector<std::string>& required,
                  const std::vector<std::string>& optional = {});

}  // namespace orthodyn
