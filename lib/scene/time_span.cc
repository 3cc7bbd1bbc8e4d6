#include "lib/scene/time_span.h"

namespace orthodyn {

const Spec<TimeSpan>& TimeSpan::spec() {
  static const auto s = Spec<TimeSpan>()
                            .key("start", &TimeSpan::start, "Initial time.", {.unit = "s"})
                            .key("end", &TimeSpan::end, "Final time.", {.required = true, .unit = "s"});
  return s;
}

}  // namespace orthodyn
