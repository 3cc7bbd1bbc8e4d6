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

// Gives composite sections without an *ORIENTATION, as CalculiX writes them, the orientation of their first ply. Call
// it before regions and axes are computed.
void complete_composites(AbaqusFile& file);

// The plies of composite regions, by region, from bottom to top along axis 3. `axes`: of each cell; empty for
// the identity. Throws ConfigError unless all cells have their plies stacked along axis 3 in the same sense and turned
// about axis 3 by the same angles.
std::map<std::string, std::vector<MeshPly>> layups_of_regions(const AbaqusFile& file, AbaqusLookup& lookup,
                                                              const AbaqusRegions& regions,
                                                              const std::vector<Mat3>& axes);

// The material `name` (in capitals). If the file lacks it, the result has a `problem`.
MeshMaterial abaqus_material(const AbaqusFile& file, const std::string& name, FilePlace section);

// The mean of the corners of a cell, m.
Vec3 centre_of(const FileCell& cell, const AbaqusLookup& lookup);

}  // namespace orthodyn
