// What both kinds of VTK files say: an unstructured grid with values per cell and per point, and its numbers as text
// or as bytes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

inline constexpr int kVtkTetra = 10, kVtkQuadraticTetra = 24;  // in vtkCellType.h

// Numbers as read; nothing is checked yet.
struct VtkGrid {
  std::string path;
  std::vector<double> points = {};        // x, y, z of each
  std::vector<double> connectivity = {};  // points of all cells
  std::vector<double> offsets = {};       // for each cell where its points end in `connectivity`
  std::vector<double> types = {};         // of each cell, vtkCellType.h
  std::vector<CellData> cell_data = {}, point_data = {};
  std::vector<std::string> region_names = {};  // by number, of field data "region_names"; may be empty
};

// Linear or quadratic tets become the mesh, and hexahedra, voxels, wedges and pyramids split into tets; vertices, lines
// and faces are ignored with a warning; other cells are refused by name. The integer cell data "region" (or
// "gmsh:physical", as meshio names it) makes regions "region<k>", in ascending order; point data "nodes:NAME" makes the
// node set NAME of the points where it is not zero. All cell data are kept, for the tets. Throws ConfigError "file:
// found, remedy" with the number of the cell or point, counted from 0.
LoadedMesh build_vtk_mesh(VtkGrid grid);

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
