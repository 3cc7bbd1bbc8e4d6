// The added laws (lib/fem/added_laws) of the parts of a scene.
#pragma once

#include <memory>
#include <vector>

#include "lib/fem/added_laws/added_law.h"
#include "lib/fem/element_mesh.h"
#include "lib/scene/elastic_parts.h"

namespace orthodyn {

struct Scene;

// The laws of a part for its elements `cells`, which are indices of `mesh`, the whole mesh; maybe none on a rank.
// `stiffness`: of the part's elastic law, Pa. Empty if neither the material nor the scene names one. Throws
// ConfigError.
std::vector<std::unique_ptr<const AddedLaw>> added_laws(const Scene& scene, const ElasticPart& part,
                                                        const Mat6& stiffness, const ElementMesh& mesh,
                                                        const std::vector<int>& cells);

// The law that takes the place of the corotational one in a part; null for none.
std::unique_ptr<const AddedLaw> replacing_law(const Scene& scene, const ElasticPart& part);

// Whether moisture or temperature makes the material swell.
bool swells(const Scene& scene, const Material& material);

bool is_viscoelastic(const Material& material);
bool any_viscoelastic(const Scene& scene);

// Sets the traits that the added laws of the regions' materials change.
void declare_added_laws(const Scene& scene, const std::vector<const Region*>& regions, Traits& traits);

// Throws ConfigError if an option conflicts with an added law, or if a section such as `moisture` has no effect.
void check_added_laws(const Config& config, const Scene& scene);

}  // namespace orthodyn
