// A state of a FemModel, and the intermediate results that outputs share. Each result is computed at its first use.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lib/fem/fem_model.h"
#include "lib/fem/nodal_fields.h"

namespace orthodyn {

class FemStateView : public StateView {
 public:
  // `parts` must outlive this object.
  FemStateView(const FemModel::Parts& parts, const State& state)
      : parts_(parts),
        z_(state.z),
        lambda_(state.lambda),
        angles_(state.angles),
        nodal_(parts, state.t, state.q, state.v, state.load_factor) {
    if (z_.size() > 0) nodal_.internal = &internal_;
  }
  FemStateView(const FemStateView&) = delete;  // internal_ refers to z_
  FemStateView& operator=(const FemStateView&) = delete;

  std::vector<double> evaluate(const std::string& name) const override;
  std::vector<double> evaluate_at(const std::string& name, int node, int components) const override;

  const FemModel::Parts& parts() const { return parts_; }
  const NodalExpansion& nodal() const { return nodal_; }
  NodalState state() const { return nodal_.state(); }
  const Vector& multipliers() const { return lambda_; }  // empty without joints
  const Vector& angles() const { return angles_; }       // State::angles

  // Energy of all terms of one kind, J.
  double energy(EnergyKind kind) const;

  // v_f M_ff v_f/2 + v_f M_fc v_c + v_c M_cc v_c/2 (J) with the velocities v of free coordinates f and moved
  // coordinates c.
  double kinetic_energy() const;

  // Nodal momentum, kg m/s: M_ff v_f without moved nodes, else M v.
  const NodalVector& momentum() const;

  // Tensors recovered at the nodes, and the mesh error estimated from them (stress_recovery.h).
  RecoveredTensors& recovered() const;
  const std::vector<RegionMeshError>& mesh_errors() const;

  // Reactions (N) at clamped and moved coordinates, zero elsewhere: M a + alpha M v - f with the forces f of all terms,
  // the accelerations a of all nodes and the mass-proportional damping alpha (1/s).
  const NodalVector& support_forces() const;
  // The forces (N) of the leaders on tied nodes: M a + alpha M v - f, with the forces f on the nodes and on those that
  // follow them. Zero for other nodes.
  const NodalVector& tie_forces() const;

 private:
  NodalVector forces() const;  // of terms and joints, N
  NodalVector lumped_inertia_of_ties(const NodalVector& f) const;
  Vector free_velocity() const;
  const Vector& free_momentum() const;

  const FemModel::Parts& parts_;
  Vector z_;       // internal variables
  Vector lambda_;  // multipliers of the joints
  Vector angles_;  // of hinges
  InternalState internal_{InternalState::Kind::given, z_.data(), 0};
  NodalExpansion nodal_;
  mutable std::optional<double> kinetic_energy_;
  mutable std::optional<Vector> free_momentum_;
  mutable std::optional<NodalVector> momentum_, support_forces_, tie_forces_;
  mutable std::optional<RecoveredTensors> recovered_;
  mutable std::optional<std::vector<RegionMeshError>> mesh_errors_;
  mutable std::map<std::string, std::vector<double>> whole_fields_;  // of all ranks, for evaluate_at()
};

// How the values of several ranks are combined. `minimum` and `maximum` compare the first value; a second value is its
// location. `none`: all ranks have the same values.
enum class Reduction { sum, minimum, maximum, none };

struct FemOutput {
  OutputInfo info;
  std::function<std::vector<double>(const FemStateView&)> compute;
  Reduction reduction = Reduction::sum;
  std::function<std::vector<double>(const FemStateView&, int node)> compute_at = {};  // empty: from compute()
};

// The outputs that every FemModel has.
const std::vector<FemOutput>& all_outputs();

// Reaction force and torque of each support; `supports` must outlive the result.
std::vector<FemOutput> reaction_outputs(const std::vector<Support>& supports);

// The force of each tie; `ties` must outlive the result.
std::vector<FemOutput> tie_outputs(const std::vector<NamedTie>& ties);

// Force and pressure of each contact; `contacts` must outlive the result.
std::vector<FemOutput> contact_outputs(const std::vector<NamedContact>& contacts);

// The force of each joint, and the largest distance of points that should coincide; `joints` must outlive the result.
std::vector<FemOutput> joint_outputs(const std::vector<Joint>& joints);

// Outputs of stress and strain at the nodes of these parts (nodal_fields.h); NaN at other nodes.
std::vector<FemOutput> nodal_outputs(const FieldParts& parts);

}  // namespace orthodyn
