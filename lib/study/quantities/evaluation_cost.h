// Cost of computing one point. To add a cost, add a member and a row in cost_fields().
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "lib/ode/statistics.h"

namespace orthodyn {

struct EvaluationCost {
  double cpu_seconds = 0, wall_seconds = 0;
  // Counts; empty if only modes were computed.
  std::optional<long> steps = {}, rejected_steps = {}, newton_iterations = {}, forces = {}, tangents = {},
                      factorizations = {}, solves = {};
  double peak_memory = 0;  // bytes

  // Copies the counts of a run.
  void count(const Statistics& s) {
    steps = s.steps;
    rejected_steps = s.rejected_steps;
    newton_iterations = s.newton_iterations;
    forces = s.force.count;
    tangents = s.tangent.count;
    factorizations = s.factorization.count;
    solves = s.solve.count;
  }
};

// A cost: its name in the input and in results ("cpu_seconds"), its unit and its member.
struct CostField {
  const char* name;
  const char* unit;
  std::variant<double EvaluationCost::*, std::optional<long> EvaluationCost::*> member;
};

inline const std::vector<CostField>& cost_fields() {
  using C = EvaluationCost;
  static const std::vector<CostField> all = {{"cpu_seconds", "s", &C::cpu_seconds},
                                             {"wall_seconds", "s", &C::wall_seconds},
                                             {"steps", "", &C::steps},
                                             {"rejected_steps", "", &C::rejected_steps},
                                             {"newton_iterations", "", &C::newton_iterations},
                                             {"forces", "", &C::forces},
                                             {"tangents", "", &C::tangents},
                                             {"factorizations", "", &C::factorizations},
                                             {"solves", "", &C::solves},
                                             {"peak_memory", "bytes", &C::peak_memory}};
  return all;
}

}  // namespace orthodyn
