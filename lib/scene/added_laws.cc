#include "lib/scene/added_laws.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/fem/added_laws/neo_hookean.h"
#include "lib/fem/added_laws/swelling.h"
#include "lib/fem/added_laws/viscoelastic.h"
#include "lib/scene/fibre_laws.h"
#include "lib/scene/scene.h"

namespace orthodyn {

namespace {

// A field of the scene with the material's coefficients for it.
struct Cause {
  const char* name;           // key of the scene and of Expansion
  const StateChange* change;  // null if the scene does not give it
  std::optional<Vec3> coefficients;
};

std::vector<Cause> causes(const Scene& scene, const Material& material) {
  const Expansion expansion = material.expansion().value_or(Expansion{});
  const auto given = [](const std::optional<StateChange>& change) { return change ? &*change : nullptr; };
  std::vector<Cause> all{{"moisture", given(scene.moisture), expansion.moisture},
                         {"temperature", given(scene.temperature), expansion.temperature}};
  std::erase_if(all, [](const Cause& cause) { return !cause.change || !cause.coefficients; });
  return all;
}

void check_neo_hookean(const Scene& scene, const Region& region) {
  for (const std::string& name : region.materials()) {
    const Material& material = material_named(scene, name);
    if (!std::holds_alternative<IsotropicStiffness>(material.stiffness()))
      region.origin.fail(fmt::format("law: neo_hookean needs isotropic materials, and '{}' is not isotropic", name));
    if (!causes(scene, material).empty())
      region.origin.fail("law: neo_hookean cannot be combined with an expansion by moisture or temperature");
    if (is_viscoelastic(material))
      region.origin.fail(
          fmt::format("law: neo_hookean cannot be combined with viscoelastic materials such as '{}'", name));
  }
  if (region.formulation == Formulation::mixed)
    region.origin.fail("formulation: mixed is not available with law: neo_hookean");
  if (scene.harmonic && !scene.harmonic->losses.empty())
    region.origin.fail("law: neo_hookean is not available with harmonic.losses; use damping or damping_ratio");
  if (region.stiffness_factors) region.origin.fail("law: neo_hookean has no stiffness_factors");
}

}  // namespace

bool is_viscoelastic(const Material& material) { return !material.viscoelasticity().empty(); }

bool any_viscoelastic(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const auto& entry) { return is_viscoelastic(*entry.second); });
}

bool swells(const Scene& scene, const Material& material) { return !causes(scene, material).empty(); }

std::vector<std::unique_ptr<const AddedLaw>> added_laws(const Scene& scene, const ElasticPart& part,
                                                        const Mat6& stiffness, const ElementMesh& mesh,
                                                        const std::vector<int>& cells) {
  std::vector<std::unique_ptr<const AddedLaw>> laws = fibre_laws(scene, part, mesh, cells);
  const Kinematics kinematics = elasticity_of(scene, *part.entry).kinematics;
  std::vector<Swelling> swellings;
  for (const Cause& cause : causes(scene, *part.material))
    swellings.push_back(
        {cause.name, *cause.coefficients,
         cause.change->at_points(*part.type, mesh, cells, part.cells, scene.time.start, scene.time.end)});
  const Viscoelasticity& branches = part.material->viscoelasticity();
  if (!swellings.empty()) laws.push_back(make_swelling(relaxed_stiffness(branches, stiffness), kinematics, swellings));
  if (!branches.empty()) laws.push_back(make_viscoelastic(stiffness, kinematics, branches, std::move(swellings)));
  return laws;
}

std::unique_ptr<const AddedLaw> replacing_law(const Scene& scene, const ElasticPart& part) {
  if (part.entry->law != ElasticLaw::neo_hookean) return nullptr;
  const Stiffness stiffness = part.material->stiffness();
  const auto* isotropic = std::get_if<IsotropicStiffness>(&stiffness);
  if (!isotropic) part.entry->origin.fail("law: neo_hookean needs an isotropic material");
  return make_neo_hookean(*isotropic, stiffness_damping(scene, *part.entry));
}

void declare_added_laws(const Scene& scene, const std::vector<const Region*>& regions, Traits& traits) {
  for (const Region* region : regions)
    for (const std::string& material : region->materials()) {
      declare_fibres(scene, material_named(scene, material), traits);
      if (is_viscoelastic(material_named(scene, material))) {
        traits.dissipative = true;
        traits.conservative = false;
      }
      for (const Cause& cause : causes(scene, material_named(scene, material)))
        if (!cause.change->constant()) {
          traits.time_dependent = traits.loaded = true;
          traits.conservative = false;
        }
    }
}

void check_added_laws(const Config& config, const Scene& scene) {
  for (const auto& [name, region] : scene.regions)
    if (region.law == ElasticLaw::neo_hookean) check_neo_hookean(scene, region);
  check_fibres(config, scene);
  if (scene.elasticity.corotation == Corotation::warped)
    for (const auto& [name, material] : scene.materials)
      if (is_viscoelastic(*material))
        config.at("elasticity")
            .fail(fmt::format(
                "corotation: warped is not available with viscoelastic materials such as '{}'; remove one of them",
                name));
  const auto check = [&](const char* name, const std::optional<StateChange>& change, auto&& coefficients) {
    if (!change) return;
    const bool is_used = std::any_of(scene.materials.begin(), scene.materials.end(), [&](const auto& entry) {
      const auto expansion = entry.second->expansion();
      return expansion && coefficients(*expansion);
    });
    if (!is_used)
      config.at(name).fail(fmt::format(
          "has no effect: no material has coefficients of expansion by {0}; give one `expansion: {{{0}: ...}}`", name));
    if (scene.elasticity.corotation == Corotation::warped)
      config.at(name).fail("is not available with elasticity.corotation: warped; remove one of them");
  };
  check("moisture", scene.moisture, [](const Expansion& e) { return e.moisture.has_value(); });
  check("temperature", scene.temperature, [](const Expansion& e) { return e.temperature.has_value(); });
}

}  // namespace orthodyn
