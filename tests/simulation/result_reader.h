// Reads back what a run has written: frames and tables.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/simulation/run_program.h"

namespace orthodyn {

// The arrays of a .vtu in single (or double) precision, by name.
template <class Number = float>
std::map<std::string, std::vector<Number>> read_fields(const fs::path& path) {
  const std::string text = read_text(path);
  const std::string mark = "<AppendedData encoding=\"raw\">\n_";
  const auto base = text.find(mark) + mark.size();
  std::map<std::string, std::vector<Number>> fields;
  const std::string opening =
      sizeof(Number) == sizeof(float) ? "<DataArray type=\"Float32\" Name=\"" : "<DataArray type=\"Float64\" Name=\"";
  for (auto at = text.find(opening); at < base; at = text.find(opening, at + 1)) {
    const auto name = at + opening.size(), offset = text.find("offset=\"", at) + 8;
    std::uint64_t bytes = 0;
    const char* block = text.data() + base + std::stoul(text.substr(offset));
    std::memcpy(&bytes, block, sizeof bytes);
    auto& values = fields[text.substr(name, text.find('"', name) - name)];
    values.resize(bytes / sizeof(Number));
    std::memcpy(values.data(), block + sizeof bytes, bytes);
  }
  return fields;
}

// The times of a .pvd.
inline std::vector<double> read_times(const fs::path& path) {
  const std::string text = read_text(path);
  std::vector<double> times;
  for (auto at = text.find("timestep=\""); at != std::string::npos; at = text.find("timestep=\"", at + 1))
    times.push_back(std::stod(text.substr(at + 10)));
  return times;
}

// The rows of a CSV file without its header.
inline std::vector<std::vector<double>> read_rows(const fs::path& path) {
  std::istringstream text(read_text(path));
  std::vector<std::vector<double>> rows;
  std::string line, cell;
  std::getline(text, line);
  while (std::getline(text, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

}  // namespace orthodyn
