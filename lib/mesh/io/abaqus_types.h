// Element types of Abaqus by name.
//
// Source: Abaqus elements guide, "three-dimensional solid element library"; C3D10I: older versions.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "lib/mesh/cell_kind.h"

namespace orthodyn {

struct AbaqusShape {
  std::size_t nodes = 0, corners = 0;  // nodes per element, of which the first `corners` are corners
  std::optional<CellKind> solid = {};  // empty: a face
};

// `type` in capitals. Empty unless it is a supported solid, plane, shell, membrane or rigid element.
std::optional<AbaqusShape> abaqus_shape(const std::string& type);

// "tetrahedra (C3D4, C3D4H, ...), ..., pyramids (...)"
std::string abaqus_solids();

}  // namespace orthodyn
