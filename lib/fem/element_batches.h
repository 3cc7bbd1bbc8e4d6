// The elements of one region in batches of Batch::kLanes: node numbers and, per point, shape gradients and volume, lane
// by lane. The last batch is padded with copies of the last element with zero volume. They add nothing, and use only
// nodes of the last group of elements (element_groups.h).
//
// Const functions may run concurrently for elements without a common node, or with different force vectors.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "lib/element/batch.h"
#include "lib/element/element.h"
#include "lib/fem/dof_map.h"
#include "lib/fem/element_axes.h"
#include "lib/fem/element_mesh.h"

namespace orthodyn {

inline namespace ORTHODYN_LANES {

template <Element E>
class ElementBatches {
 public:
  static constexpr int kLanes = Batch::kLanes, kNodes = E::kNodes, kPoints = E::kPoints;
  using Nodes = std::array<int, static_cast<std::size_t>(kNodes)>;

  // `axes` are in the order of `cells`. The mesh need not outlive this object.
  ElementBatches(const ElementMesh& mesh, const std::vector<int>& cells, const ElementAxes& axes);

  int size() const { return size_; }
  int num_batches() const { return static_cast<int>(batches_.size()); }
  // Number of elements in a batch, without padding.
  int lanes(int batch) const { return std::min(kLanes, size_ - batch * kLanes); }
  std::size_t bytes() const { return batches_.capacity() * sizeof(One); }

  // Data of element k.
  Nodes nodes(int k) const { return at(k).nodes[lane(k)]; }
  ElementPoint<kNodes> point(int k, int point) const;
  // Data of a whole batch.
  ElementPoint<kNodes, Batch> points(int batch, int point) const;

  // H Q = (F - I) Q at a point of a batch or of an element, with the material axes as columns of Q. `u`: nodal
  // displacements; for nodal velocities the result is dF/dt Q.
  Mat3T<Batch> gradients(int batch, int point, const NodalVector& u) const;
  Mat3 gradient(int k, int p, const NodalVector& u) const { return point(k, p).gradient(differences_of(nodes(k), u)); }

  // Volume of a point, m^3; zero for padding.
  Batch volumes(int batch, int point) const { return Batch::load(at_point(batch, point).volume); }
  double volume(int k, int point) const { return at_point(k / kLanes, point).volume[lane(k)]; }

  // Adds the nodal forces -V dPsi/dx (N) of a point of a batch or of an element to f, where V is the point's volume and
  // Psi the energy density. `P`: the stress times the axes, P Q (Pa).
  void add_forces(int batch, int point, const Mat3T<Batch>& P, NodalVector& f) const;
  void add_force(int k, int point, const Mat3& P, NodalVector& f) const;

 private:
  static constexpr int kGradients = 3 * (kNodes - 1), kCoordinates = 3 * kNodes;
  using GradientBatch = Eigen::Matrix<Batch, kNodes - 1, 3>;
  using DifferenceBatch = Eigen::Matrix<Batch, 3, kNodes - 1>;

  struct Point {
    alignas(64) double B[kGradients][kLanes];  // column-major
    double volume[kLanes];
  };
  struct One {
    std::array<Nodes, kLanes> nodes;
    std::array<Point, static_cast<std::size_t>(kPoints)> points;
  };

  static NodeDifferences<kNodes> differences_of(const Nodes& nodes, const NodalVector& u);
  const One& at(int k) const { return batches_[static_cast<std::size_t>(k / kLanes)]; }
  const Point& at_point(int batch, int point) const {
    return batches_[static_cast<std::size_t>(batch)].points[static_cast<std::size_t>(point)];
  }
  static std::size_t lane(int k) { return static_cast<std::size_t>(k % kLanes); }

  int size_;
  std::vector<One> batches_;
};

template <Element E>
ElementBatches<E>::ElementBatches(const ElementMesh& mesh, const std::vector<int>& cells, const ElementAxes& axes)
    : size_(static_cast<int>(cells.size())),
      batches_((cells.size() + static_cast<std::size_t>(kLanes) - 1) / static_cast<std::size_t>(kLanes)) {
  for (int k = 0; k < num_batches() * kLanes; ++k) {
    const bool filler = k >= size_;
    const int element = filler ? size_ - 1 : k;
    const auto cell = static_cast<std::size_t>(cells[static_cast<std::size_t>(element)]);
    const NodeDifferences<kNodes> rest = differences<kNodes>(mesh.positions(cell));
    One& one = batches_[static_cast<std::size_t>(k / kLanes)];
    std::copy_n(mesh.cells[cell].begin(), kNodes, one.nodes[lane(k)].begin());
    for (int p = 0; p < kPoints; ++p) {
      const ElementPoint<kNodes> point = E::point(p, rest, axes.of(element, p));
      Point& out = one.points[static_cast<std::size_t>(p)];
      for (int i = 0; i < kGradients; ++i) out.B[i][lane(k)] = point.B(i);
      out.volume[lane(k)] = filler ? 0 : point.volume;
    }
  }
}

template <Element E>
auto ElementBatches<E>::point(int k, int p) const -> ElementPoint<kNodes> {
  const Point& point = at_point(k / kLanes, p);
  ElementPoint<kNodes> out;
  for (int i = 0; i < kGradients; ++i) out.B(i) = point.B[i][lane(k)];
  out.volume = point.volume[lane(k)];
  return out;
}

template <Element E>
auto ElementBatches<E>::points(int batch, int p) const -> ElementPoint<kNodes, Batch> {
  const Point& point = at_point(batch, p);
  ElementPoint<kNodes, Batch> out;
  for (int i = 0; i < kGradients; ++i) out.B(i) = Batch::load(point.B[i]);
  out.volume = Batch::load(point.volume);
  return out;
}

template <Element E>
auto ElementBatches<E>::differences_of(const Nodes& nodes, const NodalVector& u) -> NodeDifferences<kNodes> {
  NodeDifferences<kNodes> d;
  for (int a = 1; a < kNodes; ++a) d.col(a - 1) = u.col(nodes[static_cast<std::size_t>(a)]) - u.col(nodes[0]);
  return d;
}

// gradients() and add_forces() are compiled separately from the laws' kernels, with which they would compete for
// registers.
template <Element E>
[[gnu::noipa]] ORTHODYN_FLATTEN Mat3T<Batch> ElementBatches<E>::gradients(int batch, int p,
                                                                          const NodalVector& u) const {
  const One& one = batches_[static_cast<std::size_t>(batch)];
  alignas(64) double corner[kCoordinates][kLanes];
  for (std::size_t l = 0; l < kLanes; ++l)
    for (std::size_t a = 0; a < kNodes; ++a) {
      const double* node = u.data() + 3 * static_cast<std::ptrdiff_t>(one.nodes[l][a]);
      for (std::size_t i = 0; i < 3; ++i) corner[3 * a + i][l] = node[i];
    }
  const Point& point = at_point(batch, p);
  DifferenceBatch d;
  GradientBatch B;
  for (int a = 0; a < kNodes - 1; ++a)
    for (int i = 0; i < 3; ++i) {
      d(i, a) = Batch::load(corner[3 * a + 3 + i]) - Batch::load(corner[i]);
      B(a, i) = Batch::load(point.B[(kNodes - 1) * i + a]);
    }
  return d.lazyProduct(B);
}

template <Element E>
[[gnu::noipa]] ORTHODYN_FLATTEN void ElementBatches<E>::add_forces(int batch, int p, const Mat3T<Batch>& P,
                                                                   NodalVector& f) const {
  const One& one = batches_[static_cast<std::size_t>(batch)];
  const Point& point = at_point(batch, p);
  const Batch volume = Batch::load(point.volume);
  GradientBatch B;
  for (int i = 0; i < kGradients; ++i) B(i) = -volume * Batch::load(point.B[i]);
  const DifferenceBatch forces = P.lazyProduct(B.transpose());
  alignas(64) double corner[kCoordinates][kLanes];
  for (int i = 0; i < 3; ++i) {
    Batch sum = forces(i, 0);
    forces(i, 0).store(corner[3 + i]);
    for (int a = 1; a < kNodes - 1; ++a) {
      forces(i, a).store(corner[3 * a + 3 + i]);
      sum += forces(i, a);
    }
    (-sum).store(corner[i]);
  }
  for (std::size_t l = 0; l < kLanes; ++l)
    for (std::size_t a = 0; a < kNodes; ++a) {
      double* node = f.data() + 3 * static_cast<std::ptrdiff_t>(one.nodes[l][a]);
      for (std::size_t i = 0; i < 3; ++i) node[i] += corner[3 * a + i][l];
    }
}

template <Element E>
void ElementBatches<E>::add_force(int k, int p, const Mat3& P, NodalVector& f) const {
  const NodeDifferences<kNodes> forces = point(k, p).node_forces(P);
  const Nodes all = nodes(k);
  for (int a = 1; a < kNodes; ++a) f.col(all[static_cast<std::size_t>(a)]) += forces.col(a - 1);
  f.col(all[0]) -= forces.rowwise().sum();
}

}  // namespace ORTHODYN_LANES

}  // namespace orthodyn
