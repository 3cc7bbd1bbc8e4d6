// What a run has cost, over all its restarts.
#pragma once

#include "lib/ode/statistics.h"
#include "lib/simulation/checkpoint/archive.h"

namespace orthodyn {

struct Effort {
  Statistics statistics;
  double wall_seconds = 0, cpu_seconds = 0;

  Archive archive() const;
  // Throws ConfigError.
  static Effort from(const Archive& archive);
};

Effort operator+(const Effort& a, const Effort& b);

}  // namespace orthodyn
