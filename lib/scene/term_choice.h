// A term that a scene names in its list `terms`: one kind per entry of Registry<TermChoice>.
#pragma once

#include <memory>

#include "lib/config/registry.h"
#include "lib/fem/fem_model.h"

namespace orthodyn {

class TermChoice {
 public:
  virtual ~TermChoice() = default;

  // `parts` holds mesh, unknowns, pattern, mass and rest positions, which outlive the term. A tangent may
  // couple nodes of one element, and those of couplings(). Throws ConfigError.
  virtual std::unique_ptr<Term> make(const FemModel::Parts& parts) const = 0;

  // Pairs of nodes that the term's tangent couples although they share no element.
  virtual NodePairs couplings(const TetMesh& /*mesh*/) const { return {}; }

  // What changes for integrators when the model has such a term (damping_matrix, time_dependent,
  // conservative, dissipative, loaded, linear); nothing for a conservative linear force.
  virtual void declare(Traits&) const {}
};

}  // namespace orthodyn
