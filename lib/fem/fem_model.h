// Finite element model of one body, with mass, terms, clamps and moved supports, as the Model that integrators see. q
// (m) are the displacements of the free coordinates from the rest shape. With a consistent mass, moved coordinates c
// act on free coordinates f by their inertia: M_ff a_f = F_f - M_fc a_c, with forces F and accelerations a.
//
// Thread safety: as Model. The factor of the mass and the patches of the stress recovery are set up at first use, under
// a lock. Forces and tangents throw RecoverableError if a term cannot be evaluated (deformation gradient not finite,
// link of zero length).
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "lib/fem/joints.h"
#include "lib/fem/mass.h"
#include "lib/fem/motion/moved_nodes.h"
#include "lib/fem/rigid_body.h"
#include "lib/fem/stress_recovery.h"
#include "lib/fem/subdomain.h"
#include "lib/fem/term.h"
#include "lib/fem/terms/elastic_term.h"
#include "lib/mesh/mesh.h"
#include "lib/ode/model.h"

namespace orthodyn {

// A named set of clamped or moved coordinates whose reaction is an output.
struct Support {
  std::string name;
  std::vector<int> nodes;
  std::vector<std::array<bool, 3>> held;  // which components, per node
  std::vector<int> frames = {};           // nodes of held rigid bodies that have the forces on them, besides `nodes`
};

// The tied nodes of a surface, and their leaders as given, which may be tied to others.
struct NamedTie {
  std::string name;
  std::vector<TiedNode> nodes;
};

// A contact of the model's loads, with the name of its outputs.
struct NamedContact {
  std::string name;
  const Contact* contact;
};

class FemModel : public Model {
 public:
  // With several ranks, `mesh` is the whole mesh; everything else belongs to this rank's subdomain and uses its node
  // numbers.
  struct Parts {
    Mesh mesh;
    std::unique_ptr<Subdomain> subdomain = {};  // null with one rank
    std::vector<int> unknowns = {};             // indices of this rank's unknowns in the model on one rank
    std::unique_ptr<DofMap> dofs;
    std::unique_ptr<BlockPattern> pattern;
    std::unique_ptr<Mass> mass;
    std::unique_ptr<NodalVector> rest;                               // node positions at rest, m
    std::vector<std::unique_ptr<const ElementType>> ply_types = {};  // of the terms of plies
    std::vector<std::unique_ptr<ElasticTerm>> elastic;               // one per region, or per ply of a layered region
    std::vector<double> densities;                    // kg/m^3, parallel to `elastic`; of a cell with plies its mean
    std::vector<std::unique_ptr<Term>> loads;         // all other terms
    std::vector<std::string> load_descriptions = {};  // of `loads`, whole body; empty with one rank
    double mass_damping = 0;                          // 1/s
    // Static analysis: loads are evaluated at this time (s); supports move during the second before this time.
    std::optional<double> loads_at = {};
    std::unique_ptr<MovedNodes> moved;                  // null without motions
    std::unique_ptr<MovedNodes> moved_everywhere = {};  // those of all ranks; null with one rank
    std::vector<Support> supports;                      // supports whose reactions are outputs
    std::vector<Joint> joints = {};                     // distances within rigid bodies included
    std::vector<RigidBody> rigid_bodies = {};
    std::vector<NamedTie> ties = {};
    std::vector<NamedContact> contacts = {};    // among `loads`
    std::unique_ptr<TiedMass> tied_mass = {};   // null without ties or with a lumped mass
    std::unique_ptr<SupportMass> support_mass;  // null without motions and supports
    std::unique_ptr<StressRecovery> recovery;   // set by FemModel
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
  const InternalVariables* internal_variables() const override { return internal_.get(); }
  const Constraints* constraints() const override { return constraints_.get(); }
  std::vector<double> breakpoints(double start, double end) const override;
  StepLimits step_limits(double start, double end) const override;
  double longest_step(const State& state) const override;
  Angles angles(const State& state) const override;  // of the joints with an angle, in their order

  std::vector<OutputInfo> outputs() const override;
  std::unique_ptr<StateView> view(const State& state) const override;
  Geometry geometry() const override;

  const Parts& parts() const { return parts_; }

  // Inverse of part_of(): assembles the vector of all unknowns from all ranks. Collective.
  Vector whole_of(const Vector& part) const;

  // Convert a state between this rank's part and all unknowns, in the order of a model on one rank. With one rank, they
  // return the state unchanged. whole() is collective.
  State whole(const State& state) const;
  State part(const State& whole) const;

  // Memory (bytes) of each component, by name. The factor of the mass is included once it exists.
  std::vector<std::pair<std::string, std::size_t>> memory() const;

 private:
  void assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                Linearization& out) const override;
  void assemble_predicted(double t_before, const ConstVectorRef& q_before, double t, const ConstVectorRef& q,
                          Linearization& out) const override;

  Parts parts_;
  std::unique_ptr<const InternalVariables> internal_;   // null without viscoelastic materials
  std::unique_ptr<const Constraints> constraints_;      // null if no joint holds
  std::unique_ptr<const DiscreteGradient> mean_force_;  // null if a force has no energy, or with several ranks
};

// Positions (m), displacements (m) and velocities (m/s) of all nodes for a state of the free coordinates.
struct NodalExpansion {
  NodalExpansion(const FemModel::Parts& parts, double time, const ConstVectorRef& q, const ConstVectorRef& v,
                 double load_factor = 1);
  NodalState state() const { return {t, x, u, u_rate, load_factor, internal}; }
  double time;  // of the state, s
  double t;     // at which loads are evaluated, s
  double load_factor;
  const InternalState* internal = nullptr;  // as in NodalState
  NodalVector u, u_rate, x;
};

// Forces of all or of some terms on all nodes (N); loads are multiplied by the load factor. Zero for copies of other
// ranks' nodes. Collective.
NodalVector term_forces(const FemModel::Parts& parts, const NodalExpansion& nodal);
NodalVector term_forces(const FemModel::Parts& parts, const NodalExpansion& nodal,
                        const std::vector<const Term*>& some);
// Tangents of some terms, as defined by Model::linearize() and linearize_predicted(). The load factor is not applied.
// Collective.
void term_tangents(const FemModel::Parts& parts, const NodalExpansion& nodal, const std::vector<const Term*>& some,
                   TangentKind kind, Linearization& out);
void term_predicted_tangents(const FemModel::Parts& parts, const NodalExpansion& before, const NodalExpansion& nodal,
                             const std::vector<const Term*>& some, Linearization& out);
std::vector<const Term*> all_terms(const FemModel::Parts& parts);
// Names of the terms, duplicates numbered: "traction on x1 (2)".
std::vector<std::string> term_names(const std::vector<const Term*>& terms);
// Names of the parts of the force: terms ("elasticity of region wood"), "mass damping" and "pull of moved supports".
std::vector<std::string> part_names(const FemModel::Parts& parts);

// Term::description() of all terms, for the whole body.
std::vector<std::string> term_descriptions(const FemModel::Parts& parts);

// Add the forces that are not terms to the forces f (N) on free coordinates: mass-proportional damping, and the inertia
// force -M_fc a_c of moved nodes. supports_pull(): whether there are moved nodes and the mass is consistent. v: free
// velocities (m/s).
void add_mass_damping(const FemModel::Parts& parts, const NodalExpansion& nodal, const ConstVectorRef& v, VectorRef f);
bool supports_pull(const FemModel::Parts& parts);
void add_support_pull(const FemModel::Parts& parts, const NodalExpansion& nodal, VectorRef f);

// Largest ratio of a node's stiffness row sum (N/m) to its mass, 1/s^2. Collective.
double largest_quotient(const FemModel::Parts& parts, Vector row_sums);

// Sets `out` to the net force (N) on the free coordinates: `forces`, mass-proportional damping and the inertia of moved
// nodes. v: free velocities (m/s).
void free_forces(const FemModel::Parts& parts, const NodalExpansion& nodal, const ConstVectorRef& v,
                 const NodalVector& forces, VectorRef out);

// The internal variables of the model; null if no material has any. `parts` must outlive the result. Sets the numbers
// of the terms' first variables.
std::unique_ptr<const InternalVariables> make_internal_variables(FemModel::Parts& parts);

// The constraints of the joints; null if no joint holds anything. `parts` must outlive the result.
std::unique_ptr<const Constraints> make_joint_constraints(const FemModel::Parts& parts);
// The force (N) of a joint's constraints on its first body, and their torque (N m) about the point `at` or `from` of
// this body.
struct JointReaction {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
};

// Forces of all joints on the nodes (N), and the reaction of a joint that holds, at displacements u with the
// multipliers lambda; joint_reaction() is NaN without multipliers.
NodalVector joint_forces(const FemModel::Parts& parts, const NodalExpansion& nodal, const Vector& lambda);
JointReaction joint_reaction(const FemModel::Parts& parts, const Joint& joint, const NodalExpansion& nodal,
                             const Vector& lambda);
// The force (N) or torque (N m) of a joint's motor on the first body at time t (s); NaN without multipliers. The power
// of all motors, W; 0 without multipliers.
double motor_force(const FemModel::Parts& parts, const Joint& joint, double t, const Vector& lambda);
double motor_power(const FemModel::Parts& parts, const NodalExpansion& nodal, const Vector& lambda);

// The discrete gradient of the model: the sum of Term::add_mean_force() and of the damping at mid-step. `parts` must
// outlive the result. mean_force() is thread-safe, and throws RecoverableError if a corotational element is inverted or
// flat in one of the states.
std::unique_ptr<const DiscreteGradient> make_mean_force(const FemModel::Parts& parts);

}  // namespace orthodyn
