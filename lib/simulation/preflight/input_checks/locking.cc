// Nearly incompressible materials in elements without the mixed formulation: linear tetrahedra, which lock.

#include <set>
#include <string>

#include "lib/material/stiffness_contrast.h"
#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

void check_locking(const CheckContext& context, Warnings& out) {
  std::set<std::string> told;
  for (const auto& term : context.built.model->parts().elastic) {
    const ElasticRegion& region = term->definition();
    if (term->type().has_mixed_formulation() || !is_nearly_incompressible(region.stiffness)) continue;
    if (!told.insert(region.mesh_region).second) continue;
    warn(out, context.config.at("regions").where(),
         "region '{}': its material is {:.0f} times as stiff against a change of volume as in shear (nearly "
         "incompressible), and {} are then far too stiff (locking): deflections may be many times too small. Use "
         "mesh.order: 2, which has a mixed formulation for such materials",
         region.mesh_region, stiffness_contrast(term->stiffness()).ratio, topology(term->type().shape()).plural);
  }
}

}  // namespace orthodyn::input_checks
