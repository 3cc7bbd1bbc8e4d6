// Reads and writes the mesh of an Abaqus input file (.inp).
//
// Format: Abaqus keywords reference; types and faces of elements: Abaqus elements guide, "three-dimensional
// solid element library".
#pragma once

#include <string>
#include <string_view>

#include "lib/mesh/io/mesh_format.h"

namespace orthodyn {

// Reads *NODE (Cartesian, cylindrical and spherical coordinates), *ELEMENT (C3D4, C3D10, C3D8, C3D20, C3D27, C3D6,
// C3D15, and C3D5, with which all are split; with variants such as C3D8R: abaqus_types.h), *NSET and *ELSET (also
// GENERATE, and *NSET, ELSET=), *SURFACE of type ELEMENT with faces S1 to S6, SPOS and SNEG, *SOLID SECTION,
// *ORIENTATION and *DISTRIBUTION by element, *INCLUDE and INPUT=; keywords and names in any case. Regions are the
// element sets of solid sections; without sections, each element belongs to the last set that contains it. Sets of
// shells or plane elements (CPS3, S4, ...), as Gmsh writes them, become surfaces. Section orientations become the cell
// data axis_1 and axis_2, evaluated at the centre of each element.
//
// Each *INSTANCE adds a placed copy of its part. With several instances, names get the prefix of their instance
// ("Part-1-1.Side"), and a warning states the offset of its node and element numbers.
//
// Sets that contain themselves, other solid elements, keywords that generate nodes and unknown parameters
// (abaqus_parameters.cc) are errors. Elements of other kinds and all other keywords are skipped with a warning. Throws
// ConfigError "file:line: found, remedy", as read_gmsh() does.
LoadedMesh read_abaqus(const std::string& path, FileCells cells = FileCells::keep);

// Reads from a text; `path` is for messages.
LoadedMesh read_abaqus_text(const std::string& path, std::string_view text, FileCells cells = FileCells::keep);

// Writes regions, node sets and surfaces as *ELSET, *NSET and *SURFACE; names in quotes if necessary.
WrittenMesh write_abaqus(const LoadedMesh& loaded);

}  // namespace orthodyn
