#include "lib/config/csv_table.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "lib/core/errors.h"
#include "lib/core/file_kind.h"
#include "lib/core/parse_number.h"

namespace orthodyn {

namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string> entries(const std::string& line) {
  std::vector<std::string> out;
  std::size_t start = 0;
  for (;;) {
    const auto comma = line.find(',', start);
    out.push_back(trimmed(line.substr(start, comma - start)));
    if (comma == std::string::npos) return out;
    start = comma + 1;
  }
}

bool parse(const std::string& text, double& value) { return parse_number(text, value) && std::isfinite(value); }

void check_names(const CsvTable& table, const std::string& where, const std::vector<std::string>& required,
                 const std::vector<std::string>& optional) {
  const auto fail = [&](const std::string& what) {
    throw ConfigError(where, what + "; the first line names the columns: " + join(required, ",") +
                                 (optional.empty() ? "" : " and, if wanted, " + join(optional, ",")));
  };
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    const auto& name = table.names[i];
    const auto known = [&](const auto& list) { return std::find(list.begin(), list.end(), name) != list.end(); };
    double number;
    if (parse(name, number)) fail(fmt::format("found the number {} where a column name belongs", name));
    if (!known(required) && !known(optional)) fail(fmt::format("unknown column '{}'", name.substr(0, 60)));
    if (table.column(name) != i) fail(fmt::format("column '{}' occurs twice", name));
  }
  for (const auto& name : required)
    if (!table.has(name)) fail(fmt::format("column '{}' is missing", name));
}

void refuse_repeated_names(const CsvTable& table, const std::string& where) {
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    double number;
    if (parse(table.names[i], number))
      throw ConfigError(where, fmt::format("found the number {} where a column name belongs; the first line names the "
                                           "columns",
                                           table.names[i]));
    if (table.column(table.names[i]) != i)
      throw ConfigError(where, fmt::format("column '{}' occurs twice", table.names[i]));
  }
}

enum class Gaps { refused, allowed };

bool is_gap(const std::string& entry) { return entry.empty() || entry == "nan" || entry == "NaN"; }

void add_row(CsvTable& table, const std::vector<std::string>& row, int line, Gaps gaps) {
  const auto where = fmt::format("{}:{}", table.path, line);
  if (row.size() != table.names.size())
    throw ConfigError(where, fmt::format("found {} entries where {} columns are named ({})", row.size(),
                                         table.names.size(), join(table.names, ",")));
  for (std::size_t i = 0; i < row.size(); ++i) {
    double value = std::numeric_limits<double>::quiet_NaN();
    if (!(gaps == Gaps::allowed && is_gap(row[i])) && !parse(row[i], value))
      throw ConfigError(
          where, fmt::format("column {}: expected a finite number, found '{}'", table.names[i], row[i].substr(0, 60)));
    table.values.push_back(value);
  }
  table.lines.push_back(line);
}

}  // namespace

bool CsvTable::has(const std::string& name) const { return std::find(names.begin(), names.end(), name) != names.end(); }

std::size_t CsvTable::column(const std::string& name) const {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

int CsvTable::index(std::size_t row, const std::string& name) const {
  const double given = at(row, column(name));
  if (given != std::floor(given) || given < 0 || given > 2e9)
    throw ConfigError(where(row), fmt::format("column {}: expected a whole number from 0, found {}", name, given));
  return static_cast<int>(given);
}

namespace {

template <class CheckNames>
CsvTable read(const FilePath& file, Gaps gaps, const CheckNames& check) {
  if (!is_file(file.path)) throw ConfigError(file.where, "no such file: " + file.path);
  std::ifstream in(file.path);
  if (!in) throw ConfigError(file.where, "cannot be read: " + file.path);
  CsvTable table{file.path, {}, {}, {}};
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    if (line == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // a byte order mark
    const std::string content = trimmed(text);
    if (content.empty() || content[0] == '#') continue;
    if (table.names.empty()) {
      table.names = entries(text);
      check(table, fmt::format("{}:{}", file.path, line));
    } else {
      add_row(table, entries(text), line, gaps);
    }
  }
  if (table.rows() == 0) throw ConfigError(file.where, fmt::format("{} has no rows of numbers", file.path));
  return table;
}

}  // namespace

CsvTable read_csv(const FilePath& file, const std::vector<std::string>& required,
                  const std::vector<std::string>& optional) {
  return read(file, Gaps::refused,
              [&](const CsvTable& table, const std::string& where) { check_names(table, where, required, optional); });
}

CsvTable read_csv_with_gaps(const FilePath& file) { return read(file, Gaps::allowed, refuse_repeated_names); }

}  // namespace orthodyn
