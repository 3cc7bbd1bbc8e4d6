// The size of a mesh that is to be made, before it is.
#pragma once

#include "lib/config/config.h"

namespace orthodyn {

// Throws ConfigError at `cells` for more elements than can be numbered, or than the memory can hold.
void require_room(double elements, const Config& cells);

}  // namespace orthodyn
