#include "lib/fem/element_batches.h"

namespace orthodyn {

ElementBatches::ElementBatches(const TetMesh& mesh, const std::vector<int>& cells, const ElementAxes& axes)
    : size_(static_cast<int>(cells.size())),
      batches_((cells.size() + static_cast<std::size_t>(kLanes) - 1) / static_cast<std::size_t>(kLanes)) {
  for (int k = 0; k < num_batches() * kLanes; ++k) {
    const bool filler = k >= size_;
    const Tet& tet = mesh.tets[static_cast<std::size_t>(cells[static_cast<std::size_t>(filler ? 0 : k)])];
    Mat3 e;
    for (std::size_t a = 0; a < 3; ++a)
      e.col(static_cast<int>(a)) =
          mesh.nodes[static_cast<std::size_t>(tet[a + 1])] - mesh.nodes[static_cast<std::size_t>(tet[0])];
    const Tet4 shape = Tet4::from_edges(e, axes.of(filler ? 0 : k));
    One& one = batches_[static_cast<std::size_t>(k / kLanes)];
    one.tets[lane(k)] = tet;
    for (int i = 0; i < 9; ++i) one.B[i][lane(k)] = shape.B(i);
    one.volume[lane(k)] = filler ? 0 : shape.volume;
  }
}

Tet4 ElementBatches::shape(int k) const {
  const One& one = at(k);
  Tet4 out;
  for (int i = 0; i < 9; ++i) out.B(i) = one.B[i][lane(k)];
  out.volume = one.volume[lane(k)];
  return out;
}

Mat3 ElementBatches::edges(const Tet& tet, const NodalVector& x) {
  Mat3 e;
  for (int k = 0; k < 3; ++k) e.col(k) = x.col(tet[static_cast<std::size_t>(k) + 1]) - x.col(tet[0]);
  return e;
}

Mat3T<Batch> ElementBatches::gradients(int batch, const NodalVector& x) const {
  const One& one = batches_[static_cast<std::size_t>(batch)];
  alignas(64) double corner[12][kLanes];
  for (std::size_t l = 0; l < kLanes; ++l)
    for (std::size_t a = 0; a < 4; ++a) {
      const double* node = x.data() + 3 * static_cast<std::ptrdiff_t>(one.tets[l][a]);
      for (std::size_t i = 0; i < 3; ++i) corner[3 * a + i][l] = node[i];
    }
  Mat3T<Batch> e, B;
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 3; ++i) {
      e(i, a) = Batch::load(corner[3 * a + 3 + i]) - Batch::load(corner[i]);
      B(i, a) = Batch::load(one.B[3 * a + i]);
    }
  return e * B;
}

void ElementBatches::add_forces(int batch, const Mat3T<Batch>& P, NodalVector& f) const {
  const One& one = batches_[static_cast<std::size_t>(batch)];
  const Batch volume = Batch::load(one.volume);
  Mat3T<Batch> B;
  for (int i = 0; i < 9; ++i) B(i) = -volume * Batch::load(one.B[i]);
  const Mat3T<Batch> forces = P * B.transpose();
  alignas(64) double corner[12][kLanes];
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 3; ++a) forces(i, a).store(corner[3 * a + 3 + i]);
    (-(forces(i, 0) + forces(i, 1) + forces(i, 2))).store(corner[i]);
  }
  for (std::size_t l = 0; l < kLanes; ++l)
    for (std::size_t a = 0; a < 4; ++a) {
      double* node = f.data() + 3 * static_cast<std::ptrdiff_t>(one.tets[l][a]);
      for (std::size_t i = 0; i < 3; ++i) node[i] += corner[3 * a + i][l];
    }
}

void ElementBatches::add_force(int k, const Mat3& P, NodalVector& f) const {
  const Mat3 forces = shape(k).node_forces(P);
  const Tet nodes = tet(k);
  for (int a = 0; a < 3; ++a) f.col(nodes[static_cast<std::size_t>(a) + 1]) += forces.col(a);
  f.col(nodes[0]) -= forces.rowwise().sum();
}

}  // namespace orthodyn
