// A finite element model: mass, terms, clamps and moved supports of one body, as the Model that integrators see.
// q are the displacements of the free coordinates from the rest shape, m. With a consistent mass the moved
// coordinates c pull at the free ones f: M_ff a_f = f_f - M_fc a_c.
//
// Thread safety: as any Model; it holds nothing that changes but the factorised mass, which is locked. Forces and
// tangents throw RecoverableError where a term cannot be evaluated (a deformation gradient that is not finite, a link
// of length zero).
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "lib/fem/mass.h"
#include "lib/fem/motion/moved_nodes.h"
#include "lib/fem/stress_recovery.h"
#include "lib/fem/subdomain.h"
#include "lib/fem/support_mass.h"
#include "lib/fem/term.h"
#include "lib/fem/terms/elastic_term.h"
#include "lib/mesh/tet_mesh.h"
#include "lib/ode/model.h"

namespace orthodyn {

// Held or moved coordinates that have a name, for their reaction.
struct Support {
  std::string name;
  std::vector<int> nodes;
  std::vector<std::array<bool, 3>> held;  // of each node the coordinates
};

class FemModel : public Model {
 public:
  // Where several ranks hold the model, `mesh` is the whole one, and all else is of this rank's subdomain: nodes, also
  // those of terms and supports, are numbered as there.
  struct Parts {
    TetMesh mesh;
    std::unique_ptr<Subdomain> subdomain = {};  // null where the model is not in parts
    std::vector<int> unknowns = {};             // of each of this rank's its number among all
    std::unique_ptr<DofMap> dofs;
    std::unique_ptr<BlockPattern> pattern;
    std::unique_ptr<Mass> mass;
    std::unique_ptr<NodalVector> rest;                  // node positions
    std::vector<std::unique_ptr<ElasticTerm>> elastic;  // one per region
    std::vector<double> densities;                      // kg/m^3, of each of these
    std::vector<std::unique_ptr<Term>> loads;           // everything else
    std::vector<std::string> load_descriptions = {};    // of these on all ranks; empty where there is one
    double mass_damping = 0;                            // 1/s
    // s, of a static analysis: loads are always those at this time, supports are at rest a second
    // before and arrive at it.
    std::optional<double> loads_at = {};
    std::unique_ptr<MovedNodes> moved;                  // null if none
    std::unique_ptr<MovedNodes> moved_everywhere = {};  // those of all ranks
    std::vector<Support> supports;                      // those whose reactions are wanted
    std::unique_ptr<SupportMass> support_mass;          // null without either
    std::unique_ptr<StressRecovery> recovery;           // made by FemModel, with the first nodal stress
    Traits traits;
  };

  explicit FemModel(Parts parts);
  FemModel(const FemModel&) = delete;  // mean_force_ refers to parts_
  FemModel& operator=(const FemModel&) = delete;

  int num_dofs() const override { return parts_.dofs->num_dofs(); }
  const Ranks* ranks() const override { return parts_.subdomain ? &parts_.subdomain->ranks() : nullptr; }
  Eigen::Index num_dofs_of_all() const override;
  Vector part_of(const Vector& all) const override;
  const Traits& traits() const override { return parts_.traits; }
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override;
  const Pattern& pattern() const override { return parts_.pattern->pattern(); }
  void combine(const Weights& w, const Linearization& at, double* values) const override;
  void multiply_matrix(const double* values, const ConstVectorRef& x, VectorRef y) const override;
  void multiply_mass(const ConstVectorRef& x, VectorRef y) const override { parts_.mass->multiply(x, y); }
  void solve_mass(VectorRef x) const override { parts_.mass->solve(x); }
  Eigen::MatrixXd rigid_motions(const ConstVectorRef& q) const override;
  double frequency_bound() const override;
  std::vector<std::string> force_parts() const override;
  std::unique_ptr<Model> only(const std::vector<std::string>& parts) const override;
  std::optional<std::vector<std::string>> load_parts() const override;
  const DiscreteGradient* discrete_gradient() const override { return mean_force_.get(); }
  std::vector<double> breakpoints(double start, double end) const override;
  StepLimits step_limits(double start, double end) const override;

  std::vector<OutputInfo> outputs() const override;
  std::unique_ptr<StateView> view(const State& state) const override;
  Geometry geometry() const override;

  const Parts& parts() const { return parts_; }

  // Of a vector's part the whole, as part_of() takes it apart. Collective.
  Vector whole_of(const Vector& part) const;

  // Between a state of all unknowns, in the order that they have in a model that is not in parts, and this rank's part
  // of it; the same where the model is not. The first is collective.
  State whole(const State& state) const;
  State part(const State& whole) const;

  // What it takes, by part: name and bytes. Of the mass what it takes now: more once it is factored.
  std::vector<std::pair<std::string, std::size_t>> memory() const;

 private:
  void assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                Linearization& out) const override;
  void assemble_mixed(double t_before, const ConstVectorRef& q_before, double t, const ConstVectorRef& q,
                      Linearization& out) const override;

  Parts parts_;
  std::unique_ptr<const DiscreteGradient> mean_force_;  // null where a term has no energy
};

// All nodes' positions and displacements (m) and velocities (m/s) at a state of the free coordinates.
struct NodalExpansion {
  NodalExpansion(const FemModel::Parts& parts, double time, const ConstVectorRef& q, const ConstVectorRef& v,
                 double load_factor = 1);
  NodalState state() const { return {t, x, u, u_rate}; }
  double time;  // of the model, s
  double t;     // of its loads, s
  double load_factor;
  NodalVector u, u_rate, x;
};

// The forces of all terms on all nodes, N, those of loads times the load factor; of copies of other ranks' nodes they
// are zero. Collective.
NodalVector term_forces(const FemModel::Parts& parts, const NodalExpansion& nodal);
// The same of some of them.
NodalVector term_forces(const FemModel::Parts& parts, const NodalExpansion& nodal,
                        const std::vector<const Term*>& some);
std::vector<const Term*> all_terms(const FemModel::Parts& parts);
std::vector<std::string> term_names(const std::vector<const Term*>& terms);  // as force_parts() has them

// What the terms are, for people: on all ranks.
std::vector<std::string> term_descriptions(const FemModel::Parts& parts);

// Two forces that are no terms, added to the free forces f, N: mass-proportional damping, and with a consistent mass
// the inertia -M_fc a_c by which moved nodes pull at free ones. v: free velocities, m/s.
void add_mass_damping(const FemModel::Parts& parts, const NodalExpansion& nodal, const ConstVectorRef& v, VectorRef f);
bool supports_pull(const FemModel::Parts& parts);
void add_support_pull(const FemModel::Parts& parts, const NodalExpansion& nodal, VectorRef f);

// The largest quotient of a row sum of stiffness (N/m) and a nodal mass, 1/s^2. Collective.
double largest_quotient(const FemModel::Parts& parts, Vector row_sums);

// What accelerates the free coordinates: their part of these forces, less mass-proportional damping and the
// pull of moved nodes. v: free velocities.
void free_forces(const FemModel::Parts& parts, const NodalExpansion& nodal, const ConstVectorRef& v,
                 const NodalVector& forces, VectorRef out);

}  // namespace orthodyn
