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

// How the model's matrices are stored: as the elasticity's tangent allows, symmetric or not, or all entries in any
// case.
enum class MatrixStorage { by_elasticity, general };

// Loads the mesh and makes the terms that the scene names. On several ranks each has its part of the model, and all
// call this. Throws ConfigError.
BuiltScene build(const Scene& scene, const Ranks* ranks = nullptr,
                 MatrixStorage storage = MatrixStorage::by_elasticity);

// Whether the tangent of one of the scene's loads is unsymmetric, so that a symmetric matrix would hold a part of it.
bool has_unsymmetric_load(const Scene& scene, const TetMesh& mesh);

}  // namespace orthodyn
