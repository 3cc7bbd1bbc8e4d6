// Viscoelastic materials in analyses without time, and relaxation times far beyond the run.

#include "lib/scene/added_laws.h"
#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kFarBeyond = 100;  // relaxation time over duration; less than 1 % relaxes

void check_times(const CheckContext& context, const Config& place, const Viscoelasticity& branches, Warnings& out) {
  const bool from_equilibrium = context.scene.start == Start::equilibrium;
  for (std::size_t i = 0; i < branches.size(); ++i)
    if (branches[i].time > kFarBeyond * context.span())
      warn(out, place.at(i).at("time").where(),
           "{:.4g} s is {:.2g} times the duration of the run, {:.4g} s: hardly anything relaxes{}. Is it in another "
           "unit? "
           "If not, {}",
           branches[i].time, branches[i].time / context.span(), context.span(),
           from_equilibrium ? " during the run, but at its start, an equilibrium, everything has relaxed" : "",
           from_equilibrium ? "give the constants that are left after this relaxation, without the entry"
                            : "remove the entry");
}

}  // namespace

void check_relaxation(const CheckContext& context, Warnings& out) {
  for (const auto& [name, material] : context.scene.materials) {
    if (!is_viscoelastic(*material)) continue;
    const Config place = context.config.at("materials").at(name).at("viscoelastic");
    if (context.is_timed_motion()) check_times(context, place, material->viscoelasticity(), out);
    else if (context.is_static() && context.scene.analysis != Analysis::harmonic)
      warn(out, place.where(),
           "this analysis uses the relaxed stiffness, as after loads of long duration. For the response at once remove "
           "`viscoelastic`; for vibrations at a frequency use `analysis: harmonic`");
  }
}

}  // namespace orthodyn::input_checks
