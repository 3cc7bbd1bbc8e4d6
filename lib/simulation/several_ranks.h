// What of a scene several ranks can do together.
#pragma once

#include "lib/config/config.h"
#include "lib/scene/scene.h"

namespace orthodyn {

// Throws ConfigError, at the key, for what they cannot; makes choices that are open for one process only.
void require_to_run_on_ranks(Config& config, Scene& scene);

}  // namespace orthodyn
