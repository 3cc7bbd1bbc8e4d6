// Numbers the unknowns: the coordinates of all nodes that are neither clamped nor tied (ties/ties.h).
//
// With several ranks, each rank has its own nodes followed by copies of other ranks' nodes (subdomain.h). Unknowns of
// copies are numbered too, for matrices; vectors of unknowns hold only those of the rank's own nodes.
#pragma once

#include <array>
#include <vector>

#include "lib/core/types.h"
#include "lib/fem/nodal_vector.h"
#include "lib/fem/ties/ties.h"

namespace orthodyn {

class DofMap {
 public:
  // clamped[3 * node + component]: whether this coordinate is clamped.
  DofMap(int num_nodes, const std::vector<bool>& clamped) : DofMap(num_nodes, clamped, num_nodes) {}
  // The first `owned` nodes belong to this rank.
  DofMap(int num_nodes, const std::vector<bool>& clamped, int owned, Ties ties = {});

  int num_nodes() const { return static_cast<int>(dof_.size()); }
  int num_owned_nodes() const { return num_owned_nodes_; }
  int num_dofs() const { return num_dofs_; }
  int num_dofs_here() const { return num_dofs_here_; }  // copies included

  const Ties& ties() const { return ties_; }

  // Indices of a node's unknowns: consecutive, except -1 for clamped coordinates and for tied nodes.
  const std::array<int, 3>& node(int i) const { return dof_[static_cast<std::size_t>(i)]; }
  // Whether a clamp or a motion holds this coordinate. Tied nodes are not held.
  bool is_held(int i, int component) const {
    return node(i)[static_cast<std::size_t>(component)] < 0 && !ties_.is_tied(i);
  }

  // Displacements, velocities and accelerations. add_to(): adds those of the free coordinates, and of the nodes tied to
  // them, to `out`, at the rank's own nodes. restrict_to(): sets `dofs` to the free coordinates of `nodal`.
  void add_to(const ConstVectorRef& dofs, NodalVector& out) const;
  void restrict_to(const NodalVector& nodal, VectorRef dofs) const;
  // Forces and momenta. add_forces_to(): adds those of the free coordinates to `out`. restrict_forces_to(): sets `dofs`
  // to the forces on the free coordinates, with those of tied nodes.
  void add_forces_to(const ConstVectorRef& dofs, NodalVector& out) const;
  void restrict_forces_to(const NodalVector& nodal, VectorRef dofs) const;
  // add_to() and restrict_to() for own nodes and copies.
  void add_here_to(const ConstVectorRef& dofs, NodalVector& out) const;
  void restrict_here_to(const NodalVector& nodal, VectorRef dofs) const;

 private:
  template <class Visit>
  void for_each(int nodes, Visit&& visit) const;

  std::vector<std::array<int, 3>> dof_;
  Ties ties_;
  int num_owned_nodes_, num_dofs_ = 0, num_dofs_here_ = 0;
};

}  // namespace orthodyn
