// Shape gradients and volume of one integration point for a batch of elements, lane by lane.
//
// Elements without integration rules store their gradients. Isoparametric ones store the map J^-1 Q from natural
// coordinates to material axes, a sixth of the memory of a 20-node hexahedron's gradients: with the derivatives s_a of
// the shape functions in natural coordinates, the same for all elements, g_a = (J^-1 Q)^T s_a.
#pragma once

#include <array>

#include "lib/element/batch.h"
#include "lib/element/element.h"

namespace orthodyn {

inline namespace ORTHODYN_LANES {

template <Element E>
class PointBatch {
 public:
  static constexpr int kNodes = E::kNodes, kLanes = Batch::kLanes;
  // u_a - u_0, or forces on the nodes a = 1, 2, ...
  using Columns = Eigen::Matrix<Batch, 3, kNodes - 1>;

  // What all elements share at a point: nothing.
  struct Shared {};
  static Shared shared(int /*point*/, const IntegrationRule* /*rule*/) { return {}; }

  // From the node differences at rest and the material axes of an element. `is_padding`: sets the volume to zero.
  void set(int lane, int point, const NodeDifferences<kNodes>& rest, const Mat3& Q, const Shared&,
           const IntegrationRule* /*rule*/, bool is_padding) {
    const ElementPoint<kNodes> at = E::point(point, rest, Q);
    for (int i = 0; i < kGradients; ++i) B_[i][lane] = at.B(i);
    volume_[lane] = is_padding ? 0 : at.volume;
  }

  double volume(int lane) const { return volume_[lane]; }
  Batch volumes() const { return Batch::load(volume_); }

  ElementPoint<kNodes> of_lane(int lane, const Shared&) const {
    ElementPoint<kNodes> out;
    for (int i = 0; i < kGradients; ++i) out.B(i) = B_[i][lane];
    out.volume = volume_[lane];
    return out;
  }
  ElementPoint<kNodes, Batch> all(const Shared&) const {
    ElementPoint<kNodes, Batch> out;
    for (int i = 0; i < kGradients; ++i) out.B(i) = Batch::load(B_[i]);
    out.volume = volumes();
    return out;
  }

  // H Q for the displacements u.
  Mat3T<Batch> gradient(const Columns& u, const Shared&) const {
    Mat3T<Batch> out = Mat3T<Batch>::Zero();
    for (int a = 0; a < kNodes - 1; ++a)
      for (int j = 0; j < 3; ++j) {
        const Batch B = Batch::load(B_[(kNodes - 1) * j + a]);
        for (int i = 0; i < 3; ++i) out(i, j) += u(i, a) * B;
      }
    return out;
  }

  // Adds the forces -V P Q g_a to f; the `first` call sets f.
  void add_forces(const Mat3T<Batch>& P, bool first, Columns& f, const Shared&) const {
    const Mat3T<Batch> stress = -volumes() * P;
    for (int a = 0; a < kNodes - 1; ++a) {
      std::array<Batch, 3> B;
      for (int j = 0; j < 3; ++j) B[static_cast<std::size_t>(j)] = Batch::load(B_[(kNodes - 1) * j + a]);
      for (int i = 0; i < 3; ++i) {
        const Batch force = stress(i, 0) * B[0] + stress(i, 1) * B[1] + stress(i, 2) * B[2];
        f(i, a) = first ? force : f(i, a) + force;
      }
    }
  }

 private:
  static constexpr int kGradients = 3 * (kNodes - 1);
  alignas(64) double B_[kGradients][kLanes];  // column-major
  double volume_[kLanes];
};

template <HasIntegrationRules E>
class PointBatch<E> {
 public:
  static constexpr int kNodes = E::kNodes, kLanes = Batch::kLanes;
  using Columns = Eigen::Matrix<Batch, 3, kNodes - 1>;
  using Shared = Eigen::Matrix<double, kNodes - 1, 3, Eigen::RowMajor>;  // s_a of the nodes 1, 2, ...

  static Shared shared(int point, const IntegrationRule* rule) { return E::slopes(place(point, rule)); }

  void set(int lane, int point, const NodeDifferences<kNodes>& rest, const Mat3& Q, const Shared& slopes,
           const IntegrationRule* rule, bool is_padding) {
    const Mat3 J = rest * slopes, map = J.inverse() * Q;
    for (int i = 0; i < 9; ++i) map_[i][lane] = map(i);
    volume_[lane] = is_padding ? 0 : place(point, rule).weight * J.determinant();
  }

  double volume(int lane) const { return volume_[lane]; }
  Batch volumes() const { return Batch::load(volume_); }

  ElementPoint<kNodes> of_lane(int lane, const Shared& slopes) const {
    Mat3 map;
    for (int i = 0; i < 9; ++i) map(i) = map_[i][lane];
    return {slopes * map, volume_[lane]};
  }
  ElementPoint<kNodes, Batch> all(const Shared& slopes) const {
    const Mat3T<Batch> map = maps();
    ElementPoint<kNodes, Batch> out;
    for (int a = 0; a < kNodes - 1; ++a)
      for (int j = 0; j < 3; ++j)
        out.B(a, j) = slopes(a, 0) * map(0, j) + slopes(a, 1) * map(1, j) + slopes(a, 2) * map(2, j);
    out.volume = volumes();
    return out;
  }

  Mat3T<Batch> gradient(const Columns& u, const Shared& slopes) const {
    Mat3T<Batch> natural = Mat3T<Batch>::Zero();
    for (int a = 0; a < kNodes - 1; ++a)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) natural(i, j) += u(i, a) * Batch(slopes(a, j));
    return product(natural, maps());
  }

  void add_forces(const Mat3T<Batch>& P, bool first, Columns& f, const Shared& slopes) const {
    const Mat3T<Batch> stress = product(-volumes() * P, maps().transpose());
    for (int a = 0; a < kNodes - 1; ++a)
      for (int i = 0; i < 3; ++i) {
        const Batch force = stress(i, 0) * Batch(slopes(a, 0)) + stress(i, 1) * Batch(slopes(a, 1)) +
                            stress(i, 2) * Batch(slopes(a, 2));
        f(i, a) = first ? force : f(i, a) + force;
      }
  }

 private:
  static const QuadraturePoint& place(int point, const IntegrationRule* rule) {
    return (rule ? rule->points : E::points())[static_cast<std::size_t>(point)];
  }
  static Mat3T<Batch> product(const Mat3T<Batch>& A, const Mat3T<Batch>& B) {
    Mat3T<Batch> out;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) out(i, j) = A(i, 0) * B(0, j) + A(i, 1) * B(1, j) + A(i, 2) * B(2, j);
    return out;
  }
  Mat3T<Batch> maps() const {
    Mat3T<Batch> out;
    for (int i = 0; i < 9; ++i) out(i) = Batch::load(map_[i]);
    return out;
  }

  alignas(64) double map_[9][kLanes];  // J^-1 Q, column-major
  double volume_[kLanes];
};

}  // namespace ORTHODYN_LANES

}  // namespace orthodyn
