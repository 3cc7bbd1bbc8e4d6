// Numbers of VTK files, as text or as bytes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orthodyn {

// A type by its name in XML files ("Float64") or legacy ones ("double"); empty if there is none.
struct VtkType {
  char kind;          // 'i' signed, 'u' unsigned, 'f' floating point
  std::size_t width;  // bytes
};
std::optional<VtkType> vtk_type(std::string_view name);

// Bytes in this machine's order; their count must be a multiple of the width.
std::vector<double> vtk_numbers(std::string_view bytes, VtkType type);

// Numbers separated by blanks. Throws std::runtime_error naming the first word that is none.
std::vector<double> vtk_numbers(std::string_view text);

}  // namespace orthodyn
