// Element types of Abaqus by name: what elements of a type are read as.
//
// Source: Abaqus elements guide, "three-dimensional solid element library"; C3D10I is of older versions.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "lib/mesh/cell_kind.h"

namespace orthodyn {

struct AbaqusShape {
  std::size_t nodes = 0, corners = 0;  // in the file; the first of them
  std::optional<CellKind> solid = {};  // else a face
};

// By a name in capitals. None if it is no solid element that is read, and none of planes, shells, membranes and rigid
// bodies.
std::optional<AbaqusShape> abaqus_shape(const std::string& type);

// "tetrahedra (C3D4, C3D4H, ...), ..., pyramids (...)"
std::string abaqus_solids();

}  // namespace orthodyn
