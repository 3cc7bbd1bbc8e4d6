// The error of a reference, and the smallest error that can be measured against it.
#pragma once

#include <optional>

#include "lib/study/compare/comparison_run.h"

namespace orthodyn::study::compare {

bool is_exact(const Reference& reference);

// Time error of a reference: the round-off of an exact solution, or the difference from the check; empty if unknown.
std::optional<TrajectoryErrors> time_errors_of(const Reference* reference);

// The smallest error that can be measured against a reference:
//   floor = 10 e_t + 2 e_m max(1, pi n)
// where e_t is the reference's time error, e_m its estimated mesh error, and n the number of periods of the dominant
// frequency in the integration time. The mesh error changes the frequency by a relative e_m / 2, which in n periods
// becomes a phase error of pi n e_m. e_m is 0 unless the reference has its own mesh (`across_meshes`). The floor is NaN
// if e_t or e_m is unknown.
class ReferenceFloor {
 public:
  ReferenceFloor(const Reference* reference, bool across_meshes);

  // The floor in one norm. `time_error`: e_t in this norm.
  double at(double time_error) const { return 10 * time_error + 2 * mesh_error_; }
  // True for a finite error below the floor, and for any finite error if the floor is unknown.
  bool covers(double error, double time_error) const;

 private:
  double mesh_error_ = 0;
};

}  // namespace orthodyn::study::compare
