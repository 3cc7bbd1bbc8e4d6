#include "lib/simulation/output/strain_watch.h"

#include <fmt/format.h>

namespace orthodyn {

std::optional<StrainExcess> StrainWatch::of_all_ranks(std::optional<StrainExcess> here) const {
  if (!model_.ranks()) return here;
  const double share = here ? here->share : 0, largest = model_.ranks()->max(share);
  if (largest == 0 || share == largest) return here;
  return StrainExcess{largest, fmt::format("the motion strained the body to {:.3g} times the limit of the corotational "
                                           "law, in another rank's part of it",
                                           largest)};
}

void StrainWatch::observe(const ObservedState& observed) {
  last_evaluation_ = observed.t();
  const State& state = observed.state();
  const NodalExpansion nodal(model_.parts(), times_ ? times_->at(state.t) : state.t, state.q, state.v);
  if (!model_.space().any(is_near_strain_limit(model_, safe_, nodal.state()))) return;
  const double energy = observed.evaluate("energy.elastic")[0];
  if (!(energy > largest_energy_)) return;
  largest_energy_ = energy;
  const auto found = of_all_ranks(strain_excess(model_, nodal.state()));
  if (found && (!worst_ || found->share > worst_->share)) worst_ = {found->share, state.t, found->sentence};
}

void StrainWatch::save(Archive& archive) {
  archive.put("last_look", last_evaluation_);
  archive.put("largest_energy", largest_energy_);
  archive.put("worst", std::vector{worst_ ? worst_->share : 0, worst_ ? worst_->time : 0});
}

void StrainWatch::restore(const Archive& archive) {
  last_evaluation_ = archive.number("last_look");
  largest_energy_ = archive.number("largest_energy");
  const auto& worst = archive.numbers("worst", 2);
  if (worst[0] > 0)
    worst_ = {worst[0], worst[1],
              fmt::format(
                  "before the run was resumed, the body was strained to {:.3g} times the limit of the corotational law",
                  worst[0])};
}

}  // namespace orthodyn
