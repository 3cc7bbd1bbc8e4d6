// The mesh of an Abaqus input file (.inp).
//
// Format: Abaqus keywords reference; types and faces of elements: Abaqus elements guide, "three-dimensional
// solid element library".
#pragma once

#include <string>
#include <string_view>

#include "lib/mesh/io/mesh_format.h"

namespace orthodyn {

// Reads *NODE (Cartesian, cylindrical and spherical coordinates), *ELEMENT (C3D4, C3D10; C3D8, C3D20, C3D6, C3D15 and
// C3D5, which are split; each with its variants, such as C3D8R: abaqus_types.h), *NSET and *ELSET (also GENERATE, and
// *NSET, ELSET=), *SURFACE of type ELEMENT with faces S1 to S6, SPOS and SNEG, *SOLID SECTION, *ORIENTATION and
// *DISTRIBUTION by element, *INCLUDE and INPUT=; keywords and names in any case. The element sets of solid sections are
// the regions; without sections every element belongs to the last set that names it. Sets of shells or plane elements
// (CPS3, S4, ...), as Gmsh writes them, become surfaces. Orientations of sections become the cell data axis_1 and
// axis_2, at the centre of each element.
//
// Each *INSTANCE is its part where it is placed. Where there are several, names within them begin with theirs
// ("Part-1-1.Side"), and what is added to their numbers is told.
//
// Parameters that change what is read are used or refused (abaqus_parameters.h). Sets that contain themselves, other
// solid elements, and keywords that generate nodes are refused; elements of other kinds are left out, and all other
// keywords are skipped, both with a warning. Throws ConfigError "file:line: found, remedy", as read_gmsh() does.
LoadedMesh read_abaqus(const std::string& path);

// The same from a text; `path` is for messages.
LoadedMesh read_abaqus_text(const std::string& path, std::string_view text);

// Regions, node sets and surfaces as *ELSET, *NSET and *SURFACE; names in quotes where they need it.
WrittenMesh write_abaqus(const LoadedMesh& loaded);

}  // namespace orthodyn
