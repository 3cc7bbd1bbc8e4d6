// From a scene to a model that can be integrated.
#pragma once

#include <memory>

#include "lib/fem/fem_model.h"
#include "lib/ode/integrator.h"
#include "lib/scene/scene.h"

namespace orthodyn {

struct BuiltScene {
  std::unique_ptr<FemModel> model;
  State initial;
  Warnings warnings;
};

// Loads the mesh and makes the terms that the scene names. On several ranks each has its part of the model, and all
// call this. Throws ConfigError.
BuiltScene build(const Scene& scene, const Ranks* ranks = nullptr);

}  // namespace orthodyn
