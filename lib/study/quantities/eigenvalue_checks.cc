#include "lib/study/quantities/eigenvalue_checks.h"

#include <algorithm>
#include <cmath>

#include "lib/analysis/buckling.h"
#include "lib/simulation/statics/static_problem.h"
#include "lib/study/quantities/wanted_modes.h"

namespace orthodyn::study {

namespace {

void check_frequencies(const Setup& setup, std::vector<Check>& checks) {
  std::vector<WantedMetric> wanted;
  for (const auto& e : setup.scene.expect)
    if (e.mode) wanted.push_back({.mode = e.mode});
  if (wanted.empty()) return;
  const Scene scene = setup.scene.is_static() ? setup.scene : at_rest(setup.scene);
  const BuiltScene built = build(scene);
  const Vector zero = Vector::Zero(built.model->num_dofs());
  const WantedModes found = wanted_modes(wanted, *built.model, {scene.time.end, zero, zero, 0});
  auto chosen = found.chosen.begin();
  for (const auto& e : setup.scene.expect) {
    if (!e.mode) continue;
    checks.push_back({e, *chosen ? found.modes.modes[**chosen].frequency() : std::nan(""), "Hz"});
    ++chosen;
  }
}

void check_load_factors(const Setup& setup, std::vector<Check>& checks) {
  int count = 0;
  for (const auto& e : setup.scene.expect) count = std::max(count, e.buckling.value_or(0));
  if (count == 0) return;
  const double t = setup.scene.time.end;
  const FemModel& model = *setup.built.model;
  require_held(setup.scene, model, t);
  const auto modes = buckling_modes(model, unloaded_shape(setup.scene, setup.built), t, count).modes;
  for (const auto& e : setup.scene.expect) {
    if (!e.buckling) continue;
    const auto k = static_cast<std::size_t>(*e.buckling - 1);
    checks.push_back({e, k < modes.size() ? modes[k].load_factor : std::nan(""), ""});
  }
}

}  // namespace

std::vector<Check> eigenvalue_checks(const Setup& setup) {
  std::vector<Check> checks;
  check_frequencies(setup, checks);
  check_load_factors(setup, checks);
  return checks;
}

}  // namespace orthodyn::study
