#include "lib/fem/terms/load.h"

#include "lib/fem/surface.h"
#include "lib/fem/terms/dead_load.h"
#include "lib/mesh/selection.h"

namespace orthodyn {

const Spec<Load>& Load::spec() {
  static const auto s =
      Spec<Load>()
          .key("surface", &Load::surface, "A named surface of the mesh.", {.required = true})
          .key("traction", &Load::traction,
               "Dead traction per undeformed area: three numbers, or formulas of the rest position.", {.unit = "Pa"})
          .key("force", &Load::force, "Total dead force, spread evenly over the surface.", {.unit = "N"})
          .key("factor", &Load::factor, "Factor in time.", {.fallback = "{type: constant}"})
          .check([](const Load& load, const Config& config) {
            if (load.traction.has_value() == load.force.has_value()) config.fail("give exactly one of traction, force");
          });
  return s;
}

std::unique_ptr<Term> Load::make(const Discretization& body) const {
  const auto& triangles = find_surface(body.mesh, surface, origin);
  auto forces = traction ? surface_forces(body.mesh, triangles, *traction)
                         : surface_forces(body.mesh, triangles, *force / surface_area(body.mesh, triangles));
  return std::make_unique<DeadLoad>("traction on " + surface, std::move(forces), factor);
}

void Load::declare(Traits& traits) const { declare_load(*factor, traits); }

}  // namespace orthodyn
