// Nearly incompressible materials without the mixed formulation: linear tetrahedra lock, and stresses of other elements
// are wrong.

#include <set>
#include <string>

#include "lib/material/stiffness_contrast.h"
#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

void check_locking(const CheckContext& context, Warnings& out) {
  std::set<std::string> told;
  for (const auto& term : context.built.model->parts().elastic) {
    const ElasticRegion& region = term->definition();
    if (region.mixed || !is_nearly_incompressible(region.softest())) continue;
    if (!told.insert(region.mesh_region).second) continue;
    const std::string material = fmt::format(
        "region '{}': its material is {:.0f} times as stiff against a change of volume as in shear (nearly "
        "incompressible)",
        region.mesh_region, stiffness_contrast(voigt(region.softest())).ratio);
    const std::string place = context.config.at("regions").where();
    if (!term->type().has_mixed_formulation())
      warn(out, place,
           "{}, and {} are then far too stiff (locking): deflections may be many times too small. Use mesh.order: 2, "
           "which has a mixed formulation for such materials",
           material, topology(term->type().shape()).plural);
    else
      warn(out, place,
           "{}, and stresses are then wrong, by up to several times their size, without the mixed formulation: {}",
           material,
           region.options.is_warped()      ? "remove elasticity.corotation: warped"
           : region.mixed_obstacle.empty() ? "remove formulation: displacement"
                                           : fmt::format("it is not available {}. Otherwise use a smaller Poisson's "
                                                         "ratio, or judge displacements only",
                                                         region.mixed_obstacle));
  }
}

}  // namespace orthodyn::input_checks
