// Axes of elements as a file has them: one row for each element it names.
#pragma once

#include <string>
#include <vector>

#include "lib/core/values.h"

namespace orthodyn {

struct AxesRows {
  struct Row {
    int element;  // index in the mesh, from 0
    Mat3 columns;
    int line;  // for messages: of the file
  };
  std::vector<Row> rows;
  bool third;         // whether axis 3 was given too; otherwise it is 1 x 2
  bool every;         // whether rows stand for elements 0, 1, 2, ... without saying so
  std::string path;

  std::string where(const Row& row) const { return fmt::format("{}:{}", path, row.line); }
};

// Reads CSV with the columns a1x,a1y,a1z,a2x,a2y,a2z and, if wanted, element and a3x,a3y,a3z. Vectors have
// any length but zero. Throws ConfigError (see read_csv()).
AxesRows read_axes_rows(const FilePath& file);

}  // namespace orthodyn
