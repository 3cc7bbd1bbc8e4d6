// An expectation beside the metric that was computed.
#pragma once

#include <string>

#include "lib/scene/expectation.h"

namespace orthodyn::study {

struct Check {
  Expectation expectation;
  double computed = 0;  // NaN where the run has no such metric
  std::string unit = {};
  double difference() const { return computed - expectation.value; }
  bool passed() const;
};

}  // namespace orthodyn::study
