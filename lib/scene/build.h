// Builds a model from a scene.
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

// Matrix storage: symmetric if the tangents of elasticity are symmetric, or always general.
enum class MatrixStorage { by_elasticity, general };

// Loads the mesh and makes the scene's terms. With several ranks, each rank gets its part of the model; `ranks` is null
// for one rank. Collective. Throws ConfigError.
BuiltScene build(const Scene& scene, const Ranks* ranks = nullptr,
                 MatrixStorage storage = MatrixStorage::by_elasticity);

// Whether a load of the scene has an unsymmetric tangent. Symmetric storage would drop the skew part of that tangent.
bool has_unsymmetric_load(const Scene& scene, const Mesh& mesh);

}  // namespace orthodyn
