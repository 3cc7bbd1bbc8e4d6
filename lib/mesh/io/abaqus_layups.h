// *SOLID SECTION, COMPOSITE of an Abaqus input file: the plies of a region.
//
// Source: Abaqus keywords reference, *SOLID SECTION; CalculiX manual, *SOLID SECTION.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lib/mesh/io/abaqus_lookup.h"
#include "lib/mesh/io/abaqus_regions.h"

namespace orthodyn {

// A composite section without an *ORIENTATION, as CalculiX writes it, gets the orientation of its first ply. Call this
// function before regions and axes are computed.
void complete_composites(AbaqusFile& file);

// The layups of composite regions, from bottom to top along axis 3 of their axes. `axes`: of each cell; empty for the
// identity. Throws ConfigError for plies that are not stacked along axis 3 in all cells, and for a ply whose
// orientation is no turn about axis 3.
std::map<std::string, std::vector<MeshPly>> layups_of_regions(const AbaqusFile& file, AbaqusLookup& lookup,
                                                              const AbaqusRegions& regions,
                                                              const std::vector<Mat3>& axes);

// The material of this name (in capitals) or, with a problem set, one that the file lacks.
MeshMaterial abaqus_material(const AbaqusFile& file, const std::string& name, FilePlace section);

// The mean of the corners of a cell, m.
Vec3 centre_of(const FileCell& cell, const AbaqusLookup& lookup);

}  // namespace orthodyn
