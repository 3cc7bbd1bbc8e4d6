#include "lib/scene/clamp.h"

namespace orthodyn {

const Spec<Clamp>& Clamp::spec() {
  static const auto s = selection_spec<Clamp>()
                            .key("name", &Clamp::name, "Name of its reaction; default clamp_1, clamp_2 and so on.")
                            .key("components", &Clamp::components, "Which coordinates are held.")
                            .check([](const Clamp& clamp, const Config& config) {
                              clamp.check(config);
                              if (clamp.components.empty())
                                config.at("components").fail("is empty; give some of x, y, z");
                            });
  return s;
}

}  // namespace orthodyn
