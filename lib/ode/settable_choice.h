// The settings of an integrator's options, told and changed by the names of their members.
//
//   struct Options { double rtol = 1e-4; std::optional<double> h_max; };
//   class Choice : public SettableChoice<Choice>, public Options { ... };
//
// A setting that the options have no member for does not concern them.
#pragma once

#include <memory>

#include "lib/config/auto_or.h"
#include "lib/ode/integrator.h"

namespace orthodyn {

// Calls visit(member of the options, setting) for every setting that the options have.
template <class Options, class Settings, class Visit>
void for_each_setting(Options& options, Settings& settings, Visit visit) {
  if constexpr (requires { options.rtol; }) visit(options.rtol, settings.rtol);
  if constexpr (requires { options.step; }) visit(options.step, settings.step);
  if constexpr (requires { options.h0; }) visit(options.h0, settings.h0);
  if constexpr (requires { options.h_min; }) visit(options.h_min, settings.h_min);
  if constexpr (requires { options.h_max; }) visit(options.h_max, settings.h_max);
  if constexpr (requires { options.position_scale; }) visit(options.position_scale, settings.position_scale);
  if constexpr (requires { options.velocity_scale; }) visit(options.velocity_scale, settings.velocity_scale);
  if constexpr (requires { options.safety; }) visit(options.safety, settings.safety);
  if constexpr (requires { options.modes; }) visit(options.modes, settings.modes);
  if constexpr (requires { options.below; }) visit(options.below, settings.below);
  if constexpr (requires { options.max_steps; }) visit(options.max_steps, settings.max_steps);
  if constexpr (requires { options.linear_solver; }) visit(options.linear_solver, settings.linear_solver);
}

template <class V>
const V& plain_value(const V& member) {
  return member;
}
template <class V>
const std::optional<V>& plain_value(const AutoOr<V>& member) {
  return member.value;
}

// `Choice` is the class that derives from this one; it has a static spec() of its keys.
template <class Choice>
class SettableChoice : public IntegratorChoice {
 public:
  IntegratorSettings settings() const override {
    IntegratorSettings settings;
    for_each_setting(static_cast<const Choice&>(*this), settings,
                     [](const auto& member, auto& setting) { setting = plain_value(member); });
    return settings;
  }

  std::unique_ptr<IntegratorChoice> with(const IntegratorSettings& settings) const override {
    check_ranges(settings, Choice::spec().keys());
    auto changed = std::make_unique<Choice>(static_cast<const Choice&>(*this));
    for_each_setting(*changed, settings, [](auto& member, const auto& setting) {
      if (setting) member = {*setting};
    });
    return changed;
  }
};

}  // namespace orthodyn
