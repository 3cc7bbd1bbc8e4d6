// Sets of an Abaqus input file that name other sets.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "lib/mesh/io/abaqus_file.h"

namespace orthodyn {

// Refuses an element set or a node set that contains itself, in one step or by way of others, and sets that are more
// than 1000 within each other. Whoever reads the members may then follow them without a bound. Throws ConfigError.
void refuse_circles_of_sets(const AbaqusFile& file);

// The numbers of the solid elements of an element set, by its key; none if there is no such set.
std::set<std::int64_t> solids_of_set(const AbaqusFile& file, const std::string& key);

}  // namespace orthodyn
