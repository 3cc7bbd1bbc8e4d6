// An expectation beside the figure that was computed.
#pragma once

#include <string>

#include "lib/scene/expectation.h"

namespace orthodyn::study {

struct Check {
  Expectation expectation;
  double computed = 0;  // NaN where the run has no such figure
  std::string unit = {};
  double difference() const { return computed - expectation.value; }
  bool passed() const;
};

}  // namespace orthodyn::study
