// The content of legacy and XML VTK files: an unstructured grid with values per cell and per point.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

inline constexpr int kVtkTetra = 10, kVtkQuadraticTetra = 24;  // in vtkCellType.h

// A grid as read. Its numbers are not checked.
struct VtkGrid {
  std::string path;
  std::vector<double> points = {};        // x, y, z of each point
  std::vector<double> connectivity = {};  // point indices of all cells
  std::vector<double> offsets = {};       // for each cell, the end of its points in `connectivity`
  std::vector<double> types = {};         // of each cell, as in vtkCellType.h
  std::vector<CellData> cell_data = {}, point_data = {};
  std::vector<std::string> region_names = {};  // by number, from field data "region_names"; may be empty
};

// Builds the mesh of linear or quadratic tets, hexahedra, voxels, wedges and pyramids. Vertices, lines and faces are
// ignored with a warning; other cells are errors. Integer cell data "region" (meshio: "gmsh:physical") define regions
// "region<k>", in ascending order. Point data "nodes:NAME" define the node set NAME: all points with a nonzero value.
// Keeps all cell data; each tet gets the values of its cell. Throws ConfigError "file: found, remedy"; cells and points
// are numbered from 0.
LoadedMesh build_vtk_mesh(VtkGrid grid, FileCells cells);

// A number type.
struct VtkType {
  char kind;          // 'i' signed, 'u' unsigned, 'f' floating point
  std::size_t width;  // bytes
};
// The type with this name in XML files ("Float64") or legacy files ("double"); empty if it is unknown.
std::optional<VtkType> vtk_type(std::string_view name);

// Converts bytes in the order of this machine to numbers. Precondition: the count is a multiple of the width.
std::vector<double> vtk_numbers(std::string_view bytes, VtkType type);

// Parses numbers separated by blanks. Throws std::runtime_error with the first word that is not a number.
std::vector<double> vtk_numbers(std::string_view text);

}  // namespace orthodyn
