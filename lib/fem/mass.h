// Mass matrix of the free coordinates: lumped (diagonal) or consistent (on the model's pattern).
// Lumped masses of tied nodes move to their leaders (ties/ties.h).
//
//     M_ab = integral of rho N_a N_b dV (consistent),  m_a = sum over elements of rho V s_a (lumped)
//
// in kg, with density rho, shape functions N_a, element volume V and each node's share s_a of the element mass. The
// three coordinates of a node have the same mass. Rigid bodies of given inertia add the consistent mass of their frames
// (rigid_body.h). Const functions may run concurrently on different vectors.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "lib/fem/block_pattern.h"
#include "lib/fem/element_mesh.h"
#include "lib/fem/subdomain.h"
#include "lib/linear/solver.h"

namespace orthodyn {

enum class MassKind { lumped, consistent };

// The mass of four nodes, with the same matrix for each coordinate.
struct FrameMass {
  std::array<int, 4> frame;
  Eigen::Matrix4d matrix;  // kg
  std::vector<int> nodes;  // of the body
  double total() const { return matrix.sum(); }
};

// What has mass: the density of each cell, kg/m^3, and frames of rigid bodies.
struct MassSources {
  MassSources(std::vector<double> of_cells, std::vector<FrameMass> of_frames = {})
      : density(std::move(of_cells)), frames(std::move(of_frames)) {}
  std::vector<double> density;
  std::vector<FrameMass> frames;
};

class Mass {
 public:
  // `pattern` must outlive the mass, `dofs` need not. `subdomain`: this rank's part for a lumped mass on several ranks,
  // otherwise null. Precondition: a lumped mass has no frames.
  Mass(MassKind kind, const ElementMesh& mesh, const MassSources& sources, const DofMap& dofs,
       const BlockPattern& pattern, const Subdomain* subdomain = nullptr);
  ~Mass();

  bool lumped() const { return kind_ == MassKind::lumped; }
  // Mass of the body, kg, clamped nodes included.
  double total() const { return total_; }
  // Lumped masses of all nodes, kg, for either kind; 0 for copies of other ranks' nodes, and for tied nodes if lumped.
  // All nodes of a body of given inertia have equal shares.
  const Vector& nodal() const { return nodal_; }
  // Lumped masses of tied nodes before they moved to the leaders, kg, and zero for other nodes; empty without ties or
  // with a consistent mass.
  const Vector& tied() const { return tied_; }
  // Row sums of the mass matrix over all nodes, kg: the nodal forces per unit of uniform acceleration. May be negative
  // for a consistent mass.
  const Vector& row_sums() const { return lumped() ? nodal_ : row_sums_; }
  // Upper bound of squared frequencies with this mass divided by those with the lumped masses nodal(); 1 if lumped
  // and without tied nodes.
  double frequency_excess() const { return frequency_excess_; }
  // Memory (bytes), including the factor if it exists.
  std::size_t bytes() const;

  // Sets y = M x; x and y must not overlap.
  void multiply(const ConstVectorRef& x, VectorRef y) const;
  // Sets x to M^-1 x. The first call factorises a consistent mass and throws RunError if it is not positive definite.
  // Calls are serialised.
  void solve(VectorRef x) const;
  // Adds factor * M to `values`, a matrix on the pattern.
  void add_to(double factor, double* values) const;

 private:
  void move_to_leaders(const Ties& ties);
  void add_consistent(const ElementMesh& mesh, const MassSources& sources, const BlockPattern& pattern);

  MassKind kind_;
  const Pattern& pattern_;
  Vector nodal_;
  double total_ = 0, frequency_excess_;
  Vector diagonal_;             // lumped
  Vector tied_;                 // lumped
  Vector row_sums_;             // consistent
  std::vector<double> values_;  // consistent

  // For a consistent mass. The solver has a workspace, so that solves must not overlap.
  mutable std::mutex solving_;
  mutable std::unique_ptr<LinearSolver> solver_;
  mutable bool factored_ = false;
};

// Those entries M_ij of the mass matrix for which node i or j is held, one number for the three coordinates. They give
// the inertia of moved nodes and their coupling with free nodes.
class SupportMass {
 public:
  // A node is held if one of its coordinates is not an unknown.
  SupportMass(const Mass& mass, const ElementMesh& mesh, const MassSources& sources, const DofMap& dofs);

  // Returns M x (kg times the unit of x). The result is complete at held nodes; at free nodes, it is complete if x is
  // zero at free nodes.
  NodalVector times(const NodalVector& x) const { return x * matrix_; }
  std::size_t bytes() const;

 private:
  SparseMatrix matrix_;  // symmetric, both triangles
};

// The rows of the consistent mass matrix of all nodes at tied nodes, before their inertia moves to the leaders. Frames
// of rigid bodies are not tied.
class TiedMass {
 public:
  // `density` in kg/m^3, per cell.
  TiedMass(const ElementMesh& mesh, const std::vector<double>& density, const Ties& ties);

  // Returns M x (kg times the unit of x) at tied nodes, and zero elsewhere.
  NodalVector times(const NodalVector& x) const { return x * transpose_; }

 private:
  SparseMatrix transpose_;
};

// Returns x at coordinates that are not unknowns, and zero elsewhere.
NodalVector held_part(const DofMap& dofs, const NodalVector& x);

}  // namespace orthodyn
