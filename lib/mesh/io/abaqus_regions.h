// Regions of an Abaqus mesh: the element sets of its solid sections, or all element sets if there are no sections.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lib/mesh/io/abaqus_lookup.h"

namespace orthodyn {

struct AbaqusRegions {
  std::vector<const AbaqusSection*> section_of_cell;              // null: none
  std::map<std::string, const AbaqusSection*> section_of_region;  // by region name
};

// Adds the regions to the draft and assigns each cell to the last set that contains it; cells in no set form "body" or,
// beside other regions, "unassigned". Warns of elements that two sets claim and of sets that become no region. The
// sections of `file` must outlive the result.
AbaqusRegions add_abaqus_regions(AbaqusFile& file, AbaqusLookup& lookup);

}  // namespace orthodyn
