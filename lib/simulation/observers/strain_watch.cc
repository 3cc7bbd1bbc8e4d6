#include "lib/simulation/observers/strain_watch.h"

namespace orthodyn {

void StrainWatch::on_output(const ObservedState& observed) {
  const State& state = observed.state();
  const NodalExpansion nodal(model_.parts(), state.t, state.q, state.v);
  const auto found = strain_excess(model_, nodal.state());
  if (found && (!worst_ || found->share > worst_->share)) worst_ = {found->share, state.t, found->sentence};
}

}  // namespace orthodyn
