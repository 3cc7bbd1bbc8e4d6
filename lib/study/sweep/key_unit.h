// Units of scene keys by path, from their declarations.
#pragma once

#include <string>

#include "lib/config/config.h"

namespace orthodyn {

// SI unit of the number at a path such as "materials.wood.young.0"; "" for a plain number and for anything else.
// `scene`: where the `type` of each section on the path is looked up.
std::string unit_at(const std::string& path, const Config& scene);

}  // namespace orthodyn
