// Measured mode shapes: the table `shapes` beside `frequencies`.
#pragma once

#include "lib/study/fit/fit.h"
#include "lib/study/quantities/mode_matching.h"

namespace orthodyn {
class FemModel;
}

namespace orthodyn::study::fit {

// Adds the shapes of `measured` to `matching`, whose frequencies are set. Throws ConfigError for missing and unknown
// columns, shapes that are zero or known at one point only, and points outside of the body.
void read_shapes(const Measurement& measured, const FemModel& model, ModeMatching& matching);

}  // namespace orthodyn::study::fit
