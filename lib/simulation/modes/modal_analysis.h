// Undamped natural modes of a scene about its rest shape or about the equilibrium under its loads. Supports stand
// still.
#pragma once

#include <optional>

#include "lib/analysis/modes.h"
#include "lib/simulation/error_estimate/estimated_error.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

class ModalAnalysis {
 public:
  // Computes the lowest `count` modes, rigid ones included. `setup` must outlive the analysis. Throws ConfigError if
  // the model has fewer modes, or if an equilibrium is requested for a body that is not held; RunError if the modes are
  // not found.
  ModalAnalysis(const Setup& setup, int count, bool about_equilibrium);

  const FemModel& model() const { return rebuilt_ ? *rebuilt_->model : *setup_.built.model; }
  // State about which the modes are computed: at rest, or in equilibrium.
  const State& about() const { return about_; }
  const Modes& modes() const { return modes_; }
  // Estimated relative error of each frequency due to the mesh; positive if the frequency is too high, 0 for zero
  // modes.
  const std::vector<double>& mesh_errors() const { return frequency_errors_.shares; }
  const FrequencyErrors& frequency_errors() const { return frequency_errors_; }
  // True if the stiffness of loads is unsymmetric, as for pressure on a surface with free edges: the modes use its
  // symmetric part, and growing vibrations (flutter) are not found.
  bool takes_symmetric_part() const { return takes_symmetric_part_; }
  // Number of rigid modes (0 Hz): rigid motions that the geometry leaves free.
  int rigid() const { return rigid_; }

 private:
  State state_about(bool about_equilibrium) const;

  const Setup& setup_;
  Scene scene_;                        // supports stand still
  std::optional<BuiltScene> rebuilt_;  // if the supports of the scene's own model move
  State about_;
  Modes modes_;
  FrequencyErrors frequency_errors_;
  int rigid_ = 0;
  bool takes_symmetric_part_ = false;
};

}  // namespace orthodyn
