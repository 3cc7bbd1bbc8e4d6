// From the command line's arguments to a model and its integrator.
#pragma once

#include "lib/scene/setup.h"
#include "tools/orthodyn/commands.h"

namespace orthodyn {

// Reads, validates and builds; prints warnings to stderr. Throws ConfigError.
Setup set_up(const RunArguments& arguments);

}  // namespace orthodyn
