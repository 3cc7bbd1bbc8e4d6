// The elements of one region in batches of Batch::kLanes: node numbers and, per integration point, the data of
// PointBatch. The last batch is padded with copies of the last element with zero volume. They add nothing, and use only
// nodes of the last group of elements (element_groups.h).
//
// Const functions may run concurrently for elements without a common node, or with different force vectors.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "lib/element/batch.h"
#include "lib/element/element.h"
#include "lib/fem/dof_map.h"
#include "lib/fem/element_axes.h"
#include "lib/fem/element_mesh.h"
#include "lib/fem/point_batch.h"

namespace orthodyn {

inline namespace ORTHODYN_LANES {

template <Element E>
class ElementBatches {
 public:
  static constexpr int kLanes = Batch::kLanes, kNodes = E::kNodes;
  using Nodes = std::array<int, static_cast<std::size_t>(kNodes)>;
  // One column per node except the first.
  using Columns = typename PointBatch<E>::Columns;

  // `axes` are in the order of `cells`. `rule`: null for the points of E. The arguments need not outlive this object.
  ElementBatches(const ElementMesh& mesh, const std::vector<int>& cells, const ElementAxes& axes,
                 const IntegrationRule* rule);

  int size() const { return size_; }
  int num_batches() const { return static_cast<int>(nodes_.size()); }
  // A compile-time constant for elements without integration rules.
  int num_points() const {
    if constexpr (HasIntegrationRules<E>) return num_points_;
    else return E::kPoints;
  }
  // Number of elements in a batch, without padding.
  int lanes(int batch) const { return std::min(kLanes, size_ - batch * kLanes); }
  std::size_t bytes() const { return nodes_.capacity() * sizeof(nodes_[0]) + points_.capacity() * sizeof(Point); }

  // Data of element k.
  Nodes nodes(int k) const { return nodes_[static_cast<std::size_t>(k / kLanes)][lane(k)]; }
  ElementPoint<kNodes> point(int k, int point) const;
  // Data of a whole batch.
  ElementPoint<kNodes, Batch> points(int batch, int point) const;

  // u_a - u_0 for the nodes a = 1, 2, ... of a batch.
  Columns differences(int batch, const NodalVector& u) const;

  // H Q = (F - I) Q at a point of a batch or of an element, with the material axes as columns of Q. `u`: nodal
  // displacements, for a batch their differences(); for velocities the result is dF/dt Q.
  Mat3T<Batch> gradients(int batch, int point, const Columns& u) const;
  Mat3 gradient(int k, int p, const NodalVector& u) const { return point(k, p).gradient(differences_of(nodes(k), u)); }

  // Volume of a point, m^3; zero for padding.
  Batch volumes(int batch, int point) const { return at_point(batch, point).volumes(); }
  double volume(int k, int point) const { return at_point(k / kLanes, point).volume(k % kLanes); }

  // Adds the nodal forces -V dPsi/dx (N) of a point of a batch or of an element to f, where V is the point's volume and
  // Psi the energy density. `P`: the stress times the axes, P Q (Pa). For a batch, f has the forces on the nodes 1, 2,
  // ...; the `first` call sets f. scatter() then adds f, and the force on node 0, to the nodal forces of the mesh.
  void add_forces(int batch, int point, const Mat3T<Batch>& P, bool first, Columns& f) const;
  void scatter(int batch, const Columns& batch_force, NodalVector& f) const;
  void add_force(int k, int point, const Mat3& P, NodalVector& f) const;

 private:
  using Point = PointBatch<E>;
  using Shared = typename Point::Shared;
  using Lanes = std::make_index_sequence<static_cast<std::size_t>(kLanes)>;

  static NodeDifferences<kNodes> differences_of(const Nodes& nodes, const NodalVector& u);
  std::size_t index(int batch, int point) const { return static_cast<std::size_t>(batch * num_points() + point); }
  const Point& at_point(int batch, int point) const { return points_[index(batch, point)]; }
  const Shared& shared(int point) const { return shared_[static_cast<std::size_t>(point)]; }
  static std::size_t lane(int k) { return static_cast<std::size_t>(k % kLanes); }

  int size_, num_points_;
  std::vector<std::array<Nodes, kLanes>> nodes_;  // per batch
  std::vector<Point> points_;                     // batch-major
  std::vector<Shared> shared_;                    // per point
};

template <Element E>
ElementBatches<E>::ElementBatches(const ElementMesh& mesh, const std::vector<int>& cells, const ElementAxes& axes,
                                  const IntegrationRule* rule)
    : size_(static_cast<int>(cells.size())),
      num_points_(rule ? static_cast<int>(rule->points.size()) : E::kPoints),
      nodes_((cells.size() + static_cast<std::size_t>(kLanes) - 1) / static_cast<std::size_t>(kLanes)),
      points_(nodes_.size() * static_cast<std::size_t>(num_points_)) {
  for (int p = 0; p < num_points_; ++p) shared_.push_back(Point::shared(p, rule));
  for (int k = 0; k < num_batches() * kLanes; ++k) {
    const bool filler = k >= size_;
    const int element = filler ? size_ - 1 : k;
    const auto cell = static_cast<std::size_t>(cells[static_cast<std::size_t>(element)]);
    const NodeDifferences<kNodes> rest = orthodyn::differences<kNodes>(mesh.positions(cell));
    std::copy_n(mesh.cells[cell].begin(), kNodes, nodes_[static_cast<std::size_t>(k / kLanes)][lane(k)].begin());
    for (int p = 0; p < num_points_; ++p)
      points_[index(k / kLanes, p)].set(k % kLanes, p, rest, axes.of(element, p), shared(p), rule, filler);
  }
}

template <Element E>
auto ElementBatches<E>::point(int k, int p) const -> ElementPoint<kNodes> {
  return at_point(k / kLanes, p).of_lane(k % kLanes, shared(p));
}

template <Element E>
auto ElementBatches<E>::points(int batch, int p) const -> ElementPoint<kNodes, Batch> {
  return at_point(batch, p).all(shared(p));
}

template <Element E>
auto ElementBatches<E>::differences_of(const Nodes& nodes, const NodalVector& u) -> NodeDifferences<kNodes> {
  NodeDifferences<kNodes> d;
  for (int a = 1; a < kNodes; ++a) d.col(a - 1) = u.col(nodes[static_cast<std::size_t>(a)]) - u.col(nodes[0]);
  return d;
}

// Component i of one node of each lane.
template <std::size_t... lane>
Batch gathered(const double* const* nodes, int i, std::index_sequence<lane...>) {
  return Batch(Batch::Pack{nodes[lane][i]...});
}

// The following functions are compiled separately from the laws' kernels, with which they would compete for registers.
template <Element E>
[[gnu::noipa]] ORTHODYN_FLATTEN auto ElementBatches<E>::differences(int batch, const NodalVector& u) const -> Columns {
  const auto& nodes = nodes_[static_cast<std::size_t>(batch)];
  const auto at_node = [&](std::size_t a) {
    std::array<const double*, kLanes> node;
    for (std::size_t l = 0; l < kLanes; ++l) node[l] = u.data() + 3 * static_cast<std::ptrdiff_t>(nodes[l][a]);
    return Vec3T<Batch>(gathered(node.data(), 0, Lanes{}), gathered(node.data(), 1, Lanes{}),
                        gathered(node.data(), 2, Lanes{}));
  };
  const Vec3T<Batch> first = at_node(0);
  Columns out;
  for (std::size_t a = 1; a < kNodes; ++a) out.col(static_cast<int>(a) - 1) = at_node(a) - first;
  return out;
}

template <Element E>
[[gnu::noipa]] ORTHODYN_FLATTEN Mat3T<Batch> ElementBatches<E>::gradients(int batch, int p, const Columns& u) const {
  return at_point(batch, p).gradient(u, shared(p));
}

template <Element E>
[[gnu::noipa]] ORTHODYN_FLATTEN void ElementBatches<E>::add_forces(int batch, int p, const Mat3T<Batch>& P, bool first,
                                                                   Columns& f) const {
  at_point(batch, p).add_forces(P, first, f, shared(p));
}

template <Element E>
[[gnu::noipa]] ORTHODYN_FLATTEN void ElementBatches<E>::scatter(int batch, const Columns& batch_force,
                                                                NodalVector& f) const {
  const auto& nodes = nodes_[static_cast<std::size_t>(batch)];
  const auto add = [&](std::size_t a, const Vec3T<Batch>& force) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      double* node = f.data() + 3 * static_cast<std::ptrdiff_t>(nodes[l][a]);
      for (int i = 0; i < 3; ++i) node[i] += force[i][static_cast<int>(l)];
    }
  };
  Vec3T<Batch> sum = batch_force.col(0);
  for (int a = 1; a < kNodes - 1; ++a) sum += batch_force.col(a);
  add(0, -sum);
  for (std::size_t a = 1; a < kNodes; ++a) add(a, batch_force.col(static_cast<int>(a) - 1));
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
