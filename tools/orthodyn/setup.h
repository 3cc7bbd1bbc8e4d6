// From the command line's arguments to a model and its integrator.
#pragma once

#include <memory>

#include "lib/core/config.h"
#include "lib/scene/build.h"
#include "tools/orthodyn/commands.h"

namespace orthodyn {

struct Setup {
  Config config;  // resolved: every default filled in
  Scene scene;
  BuiltScene built;
  std::unique_ptr<Integrator> integrator;
};

// Reads, validates and builds; prints warnings to stderr. Throws ConfigError.
Setup set_up(const RunArguments& arguments);

}  // namespace orthodyn
