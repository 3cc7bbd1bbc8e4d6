// Reads and writes Vega FEM meshes of tetrahedra or cubes (.veg, ASCII) and lists of fixed vertices (.bou).
//
// Format: Barbic, Sin, Schroeder, Vega FEM library, user's manual, "volumetric mesh files"; behaviour
// of its reader, version 4.
#pragma once

#include <string>
#include <string_view>

#include "lib/mesh/io/mesh_format.h"

namespace orthodyn {

// Each *REGION becomes a region with the name of its *SET ("allElements" is predefined) and its material. Where sets
// overlap, the last *REGION wins, with a warning. Without *REGION the sets are the regions; without sets there is one
// region "body". Such regions have no material. Elements in no region form "unassigned", without a material. Materials
// are ENU and every ORTHOTROPIC variant; the one-ratio forms (_N1...) mean nu_ij = nu sqrt(E_i/E_j) and G_ij = G
// sqrt(E_i E_j) / (2 (1 + nu)) with a factor G (Li & Barbic 2014). R is row-major with the material axes as columns;
// deviations from orthonormality up to 1e-6 are repaired, with a warning.
//
// *INCLUDE paths are relative to the including file. Vertices and elements are numbered from 0 or 1 without gaps.
// Throws ConfigError "file:line: found, remedy", as read_gmsh() does.
LoadedMesh read_vega(const std::string& path, FileCells cells = FileCells::keep);

// Reads from a text; `path` is for messages and includes.
LoadedMesh read_vega_text(const std::string& path, std::string_view text, FileCells cells = FileCells::keep);

// A .bou file, whose vertices become a node set. It counts vertices from 1, even if the mesh counts from 0.
struct FixedVertices {
  std::string path;
  std::string set = "fixed";
};

// As above, with the node set. Also throws ConfigError for a vertex that the mesh does not have.
LoadedMesh read_vega(const std::string& path, const FixedVertices& fixed, FileCells cells = FileCells::keep);

// Writes regions as sets, materials, and the node set "fixed" as a .bou file.
WrittenMesh write_vega(const LoadedMesh& loaded);

}  // namespace orthodyn
