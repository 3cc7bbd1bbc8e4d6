// Implements IntegratorChoice::settings() and with(). A setting is the member of the same name in the options:
//
//   struct Options { double rtol = 1e-4; std::optional<double> h_max; };
//   class Choice : public SettableChoice<Choice>, public Options { ... };
//
// A setting is ignored if the options have no member of its name.
#pragma once

#include <memory>

#include "lib/config/values.h"
#include "lib/ode/integrator.h"

namespace orthodyn {

template <class V>
const V& plain_value(const V& member) {
  return member;
}
template <class V>
const std::optional<V>& plain_value(const AutoOr<V>& member) {
  return member.value;
}

// `Choice` derives from this class and has a static spec() of its keys.
template <class Choice>
class SettableChoice : public IntegratorChoice {
 public:
  IntegratorSettings settings() const override {
    IntegratorSettings settings;
    for_each_setting(static_cast<const Choice&>(*this), settings,
                     [](const char*, const auto& member, auto& setting) { setting = plain_value(member); });
    return settings;
  }

  std::unique_ptr<IntegratorChoice> with(const IntegratorSettings& settings) const override {
    check_ranges(settings, Choice::spec().keys());
    auto changed = std::make_unique<Choice>(static_cast<const Choice&>(*this));
    for_each_setting(*changed, settings, [](const char*, auto& member, const auto& setting) {
      if (setting) member = {*setting};
    });
    return changed;
  }
};

}  // namespace orthodyn
