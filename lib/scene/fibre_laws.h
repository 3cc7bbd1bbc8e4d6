// The added laws of materials with fibres (lib/fem/added_laws/fibres.h). Part of added_laws.h.
#pragma once

#include <memory>
#include <vector>

#include "lib/fem/added_laws/added_law.h"
#include "lib/fem/element_mesh.h"
#include "lib/scene/elastic_parts.h"

namespace orthodyn {

struct Scene;

// Arguments as of added_laws(). Throws ConfigError, also if the activation is outside of [0, 1] at the start, the end
// or a kink.
std::vector<std::unique_ptr<const AddedLaw>> fibre_laws(const Scene& scene, const ElasticPart& part,
                                                        const ElementMesh& mesh, const std::vector<int>& cells);

// Sets the traits that the fibres of a material change.
void declare_fibres(const Scene& scene, const Material& material, Traits& traits);

// Throws ConfigError if active fibres lack the scene's activation, or if there are none for it.
void check_fibres(const Config& config, const Scene& scene);

}  // namespace orthodyn
