// Cost of a run, summed over all restarts.
#pragma once

#include "lib/ode/statistics.h"
#include "lib/simulation/checkpoint/archive.h"

namespace orthodyn {

struct TotalCost {
  Statistics statistics;
  double wall_seconds = 0, cpu_seconds = 0;

  Archive archive() const;
  // Reads what archive() wrote. Throws ConfigError if an entry is missing.
  static TotalCost from(const Archive& archive);
};

TotalCost operator+(const TotalCost& a, const TotalCost& b);

}  // namespace orthodyn
