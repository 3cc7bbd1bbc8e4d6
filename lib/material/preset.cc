// A material from the table of presets, by name.
#include <fmt/format.h>

#include "lib/material/material.h"
#include "lib/material/presets.h"

namespace orthodyn {
namespace {

class PresetMaterial : public Material {
 public:
  static const Spec<PresetMaterial>& spec() {
    using P = PresetMaterial;
    static const auto s =
        Spec<P>()
            .key("name", &P::name_, "One of `orthodyn list presets`, which has the constants, axes and sources.",
                 {.required = true})
            .key("density", &P::own_density_, "Mass density; default that of the preset, required where it has none.",
                 {.unit = "kg/m^3", .range = kPositive})
            .key("strength", &P::strength_,
                 "Strengths along the material axes; default those of the preset, if it has any.")
            .key("expansion", &P::expansion_,
                 std::string(kExpansionSentence) + " Default: the shrinkage of the preset, if it has any.")
            .key("fibres", &P::fibres_, kFibresSentence)
            .key("viscoelastic", &P::viscoelasticity_, kViscoelasticSentence)
            .check([](const P& p, const Config& config) {
              const auto& preset = p.preset();
              if (!p.own_density_ && !preset.density)
                config.fail(
                    fmt::format("'density' is missing: {} has no measured density in its source ({}); give the one of "
                                "your material in kg/m^3",
                                preset.name, preset.source));
              if (!p.own_density_) config.fill("density", number_text(*preset.density));
            });
    return s;
  }

  double density() const override { return own_density_ ? *own_density_ : preset().density.value_or(0); }
  Stiffness stiffness() const override { return orthodyn::stiffness(preset().constants); }
  std::optional<Strength> strength() const override { return strength_ ? strength_ : preset().strength; }
  std::optional<Expansion> expansion() const override { return expansion_ ? expansion_ : preset().expansion; }

 private:
  const Preset& preset() const { return presets()[static_cast<std::size_t>(name_)]; }

  PresetName name_{};
  std::optional<double> own_density_;
};

const bool preset_registered =
    Registry<Material>::add<PresetMaterial>("preset", "Measured constants by name: woods and composites.");

}  // namespace
}  // namespace orthodyn
