// The natural modes of a scene's body without damping, its supports standing still: about rest, or about its
// equilibrium under the scene's loads.
#pragma once

#include <optional>

#include "lib/analysis/modes.h"
#include "lib/simulation/error_estimate/estimated_error.h"
#include "lib/simulation/run/setup.h"

namespace orthodyn {

class ModalAnalysis {
 public:
  // The lowest `count` modes, rigid ones included. `setup` must outlive it. Throws ConfigError if the model has fewer
  // modes, or if the body is not held and its equilibrium is asked for; RunError if they cannot be found.
  ModalAnalysis(const Setup& setup, int count, bool about_equilibrium);

  const FemModel& model() const { return rebuilt_ ? *rebuilt_->model : *setup_.built.model; }
  const State& about() const { return about_; }
  const Modes& modes() const { return modes_; }
  // Of each mode that is not at zero the share by which the mesh makes its frequency too high, estimated; 0 of others.
  const std::vector<double>& mesh_errors() const { return mesh_errors_.shares; }
  const FrequencyErrors& how_estimated() const { return mesh_errors_; }
  // Of the stiffness that loads add, such as pressure on a surface with free edges: the rest of it, by which motion may
  // grow (flutter), is left out.
  bool takes_symmetric_part() const { return takes_symmetric_part_; }
  // How many of them the geometry leaves free: 0 Hz.
  int rigid() const { return rigid_; }

 private:
  State state_about(bool equilibrium_asked) const;

  const Setup& setup_;
  Scene scene_;                        // with supports that stand still
  std::optional<BuiltScene> rebuilt_;  // where the supports of the scene's own model move
  State about_;
  Modes modes_;
  FrequencyErrors mesh_errors_;
  int rigid_ = 0;
  bool takes_symmetric_part_ = false;
};

}  // namespace orthodyn
