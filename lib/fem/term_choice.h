// A term as the input asks for it: its keys, checked, and how it is made for a body. Those of a scene's list `terms`
// are chosen by `type`, one kind per entry of Registry<TermChoice>; gravity and loads on surfaces have their own keys.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lib/config/registry.h"
#include "lib/fem/block_pattern.h"
#include "lib/fem/term.h"
#include "lib/fem/terms/elasticity_options.h"
#include "lib/mesh/tet_mesh.h"
#include "lib/ode/model.h"

namespace orthodyn {

// The body that a term acts on. All but the mesh outlives the term. Where several ranks hold the model, mesh and rest
// are of the whole body; pattern and masses are of this rank's subdomain, as Term::part() wants them.
struct Discretization {
  const TetMesh& mesh;
  const NodalVector& rest;  // node positions, m
  const BlockPattern& pattern;
  const Vector& nodal_masses;        // kg, the row sums of the mass matrix
  double mass = nodal_masses.sum();  // kg, of the whole body
};

class TermChoice {
 public:
  virtual ~TermChoice() = default;

  // Of keys that were left out and depend on the kinematics: names and values, as YAML.
  using Defaults = std::vector<std::pair<std::string, std::string>>;
  virtual Defaults defaults(const ElasticityOptions&) const { return {}; }

  // A tangent may couple nodes of one element, and those of couplings(). Throws ConfigError.
  virtual std::unique_ptr<Term> make(const Discretization& body) const = 0;

  // Pairs of nodes that the term's tangent couples although they share no element.
  virtual NodePairs couplings(const TetMesh& /*mesh*/) const { return {}; }

  // Whether -df/dx of the term is symmetric for a body that is held in these coordinates (3 node + component), but for
  // what depends on velocities. Statics then store K as it is; elsewhere its symmetric part is taken.
  virtual bool has_symmetric_tangent(const TetMesh& /*mesh*/, const std::vector<bool>& /*held*/) const { return true; }

  // What changes for integrators when the model has such a term; nothing for a conservative linear force. A force that
  // depends on velocity must say damping_matrix (else methods with a mean force leave it out), one that depends on t
  // time_dependent, one that is not linear in q and v linear = false, one with kinks smooth = false; not conservative,
  // dissipative and loaded are what energy balances go by.
  virtual void declare(Traits&) const {}
};

}  // namespace orthodyn
