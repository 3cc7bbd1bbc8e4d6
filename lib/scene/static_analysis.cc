#include "lib/scene/static_analysis.h"

namespace orthodyn {

template <>
struct Words<AtLimit> {
  static constexpr std::array<std::pair<AtLimit, const char*>, 2> list{
      {{AtLimit::stop, "stop"}, {AtLimit::jump, "jump"}}};
};

const Spec<Statics>& Statics::spec() {
  static const auto s =
      LoadStepping::spec_for<Statics>()
          .key("at_limit", &Statics::at_limit,
               "What to do where the branch of stable equilibria ends (snap-through, buckling). stop: end there; jump: "
               "look for an "
               "equilibrium on another branch.")
          .key("solver", &Statics::solver, "Finds the equilibrium of each load step.", {.fallback = "{type: kinsol}"});
  return s;
}

}  // namespace orthodyn
