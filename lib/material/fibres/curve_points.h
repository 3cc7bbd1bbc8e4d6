// A measured curve y(x) in the input: pairs of numbers, or a CSV file.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lib/config/spec.h"
#include "lib/material/fibres/monotone_cubic.h"

namespace orthodyn {

struct CurvePoints {
  std::vector<MonotoneCubic::Point> points;
  std::optional<FilePath> file;
  SourceLocation origin;

  // The points of the list or the file. `x` and `y` name the columns of the file, and the coordinates in messages; if x
  // is "stretch", the file may have the column "strain" instead, to which 1 is added. Throws ConfigError unless one of
  // points and file is given, there are at least two points, x ascends and no y is negative.
  std::vector<MonotoneCubic::Point> read(const std::string& x, const std::string& y) const;

  // As read(), for y that does not decrease.
  std::vector<MonotoneCubic::Point> read_ascending(const std::string& x, const std::string& y) const;
};

}  // namespace orthodyn
