#include "lib/simulation/modes/modal_analysis.h"

#include <algorithm>

#include "lib/analysis/rigid_freedom.h"
#include "lib/simulation/statics/static_problem.h"

namespace orthodyn {

ModalAnalysis::ModalAnalysis(const Setup& setup, int count, bool about_equilibrium)
    : setup_(setup), scene_(setup.scene.is_static() ? setup.scene : at_rest(setup.scene)) {
  if (!setup.scene.is_static() && !scene_.motions.empty()) rebuilt_ = build(scene_);
  if (model().constraints())
    throw ConfigError("joints",
                      "natural modes are not available with joints and free rigid regions; replace joints by springs, "
                      "and remove `rigid`");
  about_ = state_about(about_equilibrium);
  modes_ = natural_modes(model(), about_, count);
  // Round-off also turns the softest modes of slender bodies into zero modes. Only motions that the geometry leaves
  // free are rigid.
  if (modes_.zeros > 0) rigid_ = std::min(modes_.zeros, count_rigid_freedom(model(), about_.t));
  takes_symmetric_part_ = about_equilibrium && has_unsymmetric_load(scene_, model().parts().mesh);
  frequency_errors_ = frequency_errors_of(scene_, model(), about_, modes_);
}

State ModalAnalysis::state_about(bool about_equilibrium) const {
  const Vector zero = Vector::Zero(model().num_dofs());
  const double t = scene_.time.end;
  if (!about_equilibrium) return {t, zero, zero, 0};
  if (scene_.start == Start::equilibrium) return {t, setup_.built.initial.q, zero};
  return {t, equilibrium(scene_, rebuilt_ ? *rebuilt_ : setup_.built), zero};
}

}  // namespace orthodyn
