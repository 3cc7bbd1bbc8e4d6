// How far a reference may be off itself, and which errors cannot be told from that.
#pragma once

#include <optional>

#include "lib/study/compare/comparison_run.h"

namespace orthodyn::study::compare {

bool is_exact(const Reference& reference);

// In time: round-off of an exact solution, or the difference to the check; nothing where it is not known.
std::optional<TrajectoryErrors> time_errors_of(const Reference* reference);

// Below it an error says little of the point: ten times the reference's own in time, and where it has a mesh of its own
// (`across_meshes`) twice the estimate of that mesh's: half
// of which the frequencies of its vibrations are off, so that over n periods the phase is by pi n times it. NaN where
// either is not known.
class Reach {
 public:
  Reach(const Reference* reference, bool across_meshes);

  // In a measure in which the reference's own error in time is this.
  double of(double time_error) const { return 10 * time_error + 2 * mesh_error_; }
  bool contains(double error, double time_error) const;

 private:
  double mesh_error_ = 0;
};

}  // namespace orthodyn::study::compare
