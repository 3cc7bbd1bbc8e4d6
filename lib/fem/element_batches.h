// The tetrahedra of one region in batches of as many as a Batch has lanes: nodes, shape gradients
// and volumes side by side. The last batch is filled up with copies of volume zero.
#pragma once

#include <vector>

#include "lib/element/batch.h"
#include "lib/element/tet4.h"
#include "lib/fem/dof_map.h"
#include "lib/fem/element_axes.h"
#include "lib/mesh/tet_mesh.h"

namespace orthodyn {

class ElementBatches {
 public:
  static constexpr int kLanes = Batch::kLanes;

  // `axes` of the elements in the order of `cells`.
  ElementBatches(const TetMesh& mesh, const std::vector<int>& cells, const ElementAxes& axes);

  int size() const { return size_; }
  int num_batches() const { return static_cast<int>(batches_.size()); }
  // How many lanes of a batch are elements.
  int lanes(int batch) const { return std::min(kLanes, size_ - batch * kLanes); }
  std::size_t bytes() const { return batches_.capacity() * sizeof(One); }

  Tet tet(int k) const { return at(k).tets[lane(k)]; }
  Tet4 shape(int k) const;

  // F Q of a whole batch, resp. of one element, from nodal positions; F_rate Q from velocities.
  Mat3T<Batch> gradients(int batch, const NodalVector& x) const;
  Mat3 gradient(int k, const NodalVector& x) const { return edges(tet(k), x) * shape(k).B; }
  Batch volumes(int batch) const { return Batch::load(batches_[static_cast<std::size_t>(batch)].volume); }

  // Adds -dPsi/dx of a whole batch, resp. of one element, for the stress P Q.
  void add_forces(int batch, const Mat3T<Batch>& P, NodalVector& f) const;
  void add_force(int k, const Mat3& P, NodalVector& f) const;

 private:
  struct One {
    std::array<Tet, kLanes> tets;
    alignas(64) double B[9][kLanes];  // column-major
    double volume[kLanes];
  };

  static Mat3 edges(const Tet& tet, const NodalVector& x);
  const One& at(int k) const { return batches_[static_cast<std::size_t>(k / kLanes)]; }
  static std::size_t lane(int k) { return static_cast<std::size_t>(k % kLanes); }

  int size_;
  std::vector<One> batches_;
};

}  // namespace orthodyn
