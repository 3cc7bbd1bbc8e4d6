// A state of a FemModel with what its outputs share: each quantity is computed when it is first asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/fem/nodal_fields.h"

namespace orthodyn {

class FemStateView : public StateView {
 public:
  // `parts` must outlive it.
  FemStateView(const FemModel::Parts& parts, const State& state)
      : parts_(parts), nodal_(parts, state.t, state.q, state.v, state.load_factor) {}

  std::vector<double> evaluate(const std::string& name) const override;

  const FemModel::Parts& parts() const { return parts_; }
  const NodalExpansion& nodal() const { return nodal_; }
  NodalState state() const { return nodal_.state(); }

  // Sum of the energies of all terms of a kind, J.
  double energy(EnergyKind kind) const;

  // v_f M_ff v_f/2 + v_f M_fc v_c + v_c M_cc v_c/2 for free coordinates f and moved ones c, J.
  double kinetic_energy() const;

  // M_ff v_f, and with moved nodes M v; kg m/s.
  const NodalVector& momentum() const;

  // What is recovered from stresses at the points (stress_recovery.h).
  RecoveredTensors& recovered() const;
  const std::vector<RegionMeshError>& mesh_errors() const;

  // What the surroundings exert on held and moved nodes (reactions.h), N.
  const NodalVector& support_forces() const;

 private:
  Vector free_velocity() const;
  const Vector& free_momentum() const;
  NodalVector compute_momentum() const;

  const FemModel::Parts& parts_;
  NodalExpansion nodal_;
  mutable std::optional<double> kinetic_energy_;
  mutable std::optional<Vector> free_momentum_;
  mutable std::optional<NodalVector> momentum_, support_forces_;
  mutable std::optional<RecoveredTensors> recovered_;
  mutable std::optional<std::vector<RegionMeshError>> mesh_errors_;
};

}  // namespace orthodyn
