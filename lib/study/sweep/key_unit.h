// The unit of a key of a scene by its path, from the declarations of the keys.
#pragma once

#include <string>

#include "lib/config/config.h"

namespace orthodyn {

// In SI, of a number at "materials.wood.young.0"; "" if it has none or is no number. The scene says what the sections
// on the way are (their `type`).
std::string unit_at(const std::string& path, const Config& scene);

}  // namespace orthodyn
