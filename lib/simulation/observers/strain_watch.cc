#include "lib/simulation/observers/strain_watch.h"

namespace orthodyn {

void StrainWatch::on_output(const ObservedState& observed) {
  const double energy = observed.evaluate("energy.elastic")[0];
  if (!(energy > largest_energy_)) return;
  largest_energy_ = energy;
  const State& state = observed.state();
  const NodalExpansion nodal(model_.parts(), state.t, state.q, state.v);
  const auto found = strain_excess(model_, nodal.state());
  if (found && (!worst_ || found->share > worst_->share)) worst_ = {found->share, state.t, found->sentence};
}

}  // namespace orthodyn
