// Input of a term: its checked keys, and a factory that makes the term for a body. Entries of a scene's list `terms`
// are chosen by `type` from Registry<TermChoice>; gravity and loads on surfaces have their own keys.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lib/config/registry.h"
#include "lib/fem/block_pattern.h"
#include "lib/fem/term.h"
#include "lib/fem/terms/elasticity_options.h"
#include "lib/fem/time_functions/time_function.h"
#include "lib/mesh/mesh.h"
#include "lib/ode/model.h"

namespace orthodyn {

// The body that a term acts on. `mesh` and `rest`, always of the whole body, are valid only during make().
// `pattern` and `nodal_masses` outlive the term; with several ranks they are this rank's, for Term::part().
struct Discretization {
  const Mesh& mesh;
  const NodalVector& rest;  // node positions at rest, m
  const BlockPattern& pattern;
  const Vector& nodal_masses;        // kg, the row sums of the mass matrix
  double mass = nodal_masses.sum();  // kg, of the whole body
};

class TermChoice {
 public:
  virtual ~TermChoice() = default;

  // Defaults that depend on the kinematics, for keys that the input leaves out: pairs of key and YAML value.
  using Defaults = std::vector<std::pair<std::string, std::string>>;
  virtual Defaults defaults(const ElasticityOptions&) const { return {}; }

  // Makes the term. Its tangent may couple only nodes of the same element and the pairs of couplings(). Throws
  // ConfigError.
  virtual std::unique_ptr<Term> make(const Discretization& body) const = 0;

  // Node pairs without a common element that the term's tangent couples.
  virtual NodePairs couplings(const Mesh& /*mesh*/) const { return {}; }

  // The factor in time of a load; null for terms without one.
  virtual const TimeFunction* factor_in_time() const { return nullptr; }

  // Whether -df/dx is symmetric, apart from velocity-dependent forces, for a body that is held in the coordinates
  // `held` (3 * node + component). If not, statics store the general K, and dynamics use its symmetric part.
  virtual bool has_symmetric_tangent(const Mesh& /*mesh*/, const std::vector<bool>& /*held*/) const { return true; }

  // Sets the traits that the term changes; nothing for a conservative linear force. Set damping_matrix if the force
  // depends on velocity (methods with a mean force omit it otherwise), time_dependent if it depends on t, linear =
  // false if it is not linear in q and v, smooth = false if it has kinks. Energy balances use conservative, dissipative
  // and loaded.
  virtual void declare(Traits&) const {}
};

}  // namespace orthodyn
