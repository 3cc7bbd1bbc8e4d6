// Vega FEM's meshes of tetrahedra or cubes (.veg, ASCII) and its lists of fixed vertices (.bou).
//
// Format: Barbic, Sin, Schroeder, Vega FEM library, user's manual, "volumetric mesh files"; behaviour
// of its reader, version 4.
#pragma once

#include <string>
#include <string_view>

#include "lib/mesh/io/mesh_format.h"

namespace orthodyn {

// Each *REGION makes a region under the name of its *SET ("allElements" is predefined), with its
// material; where sets overlap the later *REGION wins, with a warning. In a file without *REGION the
// sets are the regions, and without sets all is "body"; then there are no materials. Elements in no
// region form "unassigned" and have none either. Materials: ENU and every ORTHOTROPIC variant, whose
// one-ratio forms (_N1...) follow nu_ij = nu sqrt(E_i / E_j), G_ij = G sqrt(E_i E_j) / (2 (1 + nu))
// (Li & Barbic 2014). R is row-major with the material axes as columns; it may be off by rounding
// (1e-6), which is repaired with a warning.
//
// *INCLUDE names a file relative to the one that includes. Vertices and elements count from 0 or 1,
// without gaps. Throws ConfigError "file:line: found, remedy", as read_gmsh() does.
LoadedMesh read_vega(const std::string& path);

// The same from a text; `path` is for messages and includes.
LoadedMesh read_vega_text(const std::string& path, std::string_view text);

// A .bou file: vertices, counted from 1 whatever the mesh counts from, that become a node set.
struct FixedVertices {
  std::string path;
  std::string set = "fixed";
};

// Throws ConfigError for a vertex that the mesh does not have, too.
LoadedMesh read_vega(const std::string& path, const FixedVertices& fixed);

// Regions as sets, with materials where they have them; the node set "fixed" as .bou file.
WrittenMesh write_vega(const LoadedMesh& loaded);

}  // namespace orthodyn
