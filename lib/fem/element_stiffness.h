// The stiffness of an element of n nodes, 3n x 3n as 3x3 blocks, and its way into the matrix.
#pragma once

#include <algorithm>
#include <array>

#include "lib/element/batch.h"
#include "lib/element/element.h"
#include "lib/element/tangent_form.h"
#include "lib/fem/block_pattern.h"

namespace orthodyn {

// block[a][b]; of a symmetric one b <= a only.
template <int kNodes, class T = double>
using ElementBlocks =
    std::array<std::array<Mat3T<T>, static_cast<std::size_t>(kNodes)>, static_cast<std::size_t>(kNodes)>;

namespace stiffness_detail {

constexpr std::size_t idx(int i) { return static_cast<std::size_t>(i); }

// sum_n g[n] A(m, n), the three 3x3 blocks of A contracted with the gradient of one node.
template <class T, class Gradient>
[[gnu::always_inline]] inline std::array<Mat3T<T>, 3> contract_right(const Mat9T<T>& A, const Gradient& g) {
  std::array<Mat3T<T>, 3> out;
  for (int m = 0; m < 3; ++m)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        out[idx(m)](i, j) = g[0] * A(3 * m + i, j) + g[1] * A(3 * m + i, 3 + j) + g[2] * A(3 * m + i, 6 + j);
  return out;
}

}  // namespace stiffness_detail

// Adds to the blocks of nodes 1, 2, ... what one point adds to the stiffness: K_ab = V g_a : A : g_b, N/m, with the
// tangent moduli A; sets them if it is the first point.
template <int kNodes, class C, class T>
[[gnu::noipa]] void add_point_stiffness(const TangentFormOf<C, T>& form, const ElementPoint<kNodes, T>& point,
                                        bool symmetric, bool first, ElementBlocks<kNodes, T>& K) {
  using namespace stiffness_detail;
  Mat9T<T> A = expand(form);
  turn_to_space<T>(form.R, A);
  for (int b = 1; b < kNodes; ++b) {
    const Vec3T<T> g_b = point.volume * point.B.row(b - 1).transpose();
    const auto right = contract_right<T>(A, g_b);
    for (int a = symmetric ? b : 1; a < kNodes; ++a) {
      const Vec3T<T> g = point.B.row(a - 1);
      Mat3T<T>& out = K[idx(a)][idx(b)];
      for (int i = 0; i < 9; ++i) {
        const T entry = g[0] * right[0](i) + g[1] * right[1](i) + g[2] * right[2](i);
        out(i) = first ? entry : out(i) + entry;
      }
    }
  }
}

// Sets the rows and columns of node 0, whose shape function is 1 minus the sum of the others.
template <int kNodes, class T>
void complete(bool symmetric, ElementBlocks<kNodes, T>& K) {
  using stiffness_detail::idx;
  const auto block = [&](int a, int b) -> Mat3T<T> {
    return symmetric && b > a ? Mat3T<T>(K[idx(b)][idx(a)].transpose()) : K[idx(a)][idx(b)];
  };
  const auto minus_sum = [](auto&& of) {
    Mat3T<T> sum = of(1);
    for (int b = 2; b < kNodes; ++b) sum += of(b);
    return Mat3T<T>(-sum);
  };
  for (int a = 1; a < kNodes; ++a) {
    K[idx(a)][0] = minus_sum([&](int b) { return block(a, b); });
    if (!symmetric) K[0][idx(a)] = minus_sum([&](int b) { return block(b, a); });
  }
  K[0][0] = minus_sum([&](int a) { return K[idx(a)][0]; });
}

// Where the off-diagonal blocks of an element lie in a symmetric pattern. A general pattern is
// searched at each use: it serves comparisons only, and is not worth the memory.
template <int kNodes>
class ElementOffsets {
 public:
  using Nodes = std::array<int, static_cast<std::size_t>(kNodes)>;

  ElementOffsets(const Nodes& nodes, const BlockPattern& pattern) {
    std::size_t pair = 0;
    for (std::size_t j = 0; j < kNodes; ++j)
      for (std::size_t i = j + 1; i < kNodes; ++i)
        offset_[pair++] = pattern.offset(std::max(nodes[i], nodes[j]), std::min(nodes[i], nodes[j]));
  }
  // Pairs (i, j) with i > j, i fastest.
  int operator[](int pair) const { return offset_[static_cast<std::size_t>(pair)]; }

 private:
  std::array<int, static_cast<std::size_t>(kNodes*(kNodes - 1) / 2)> offset_;
};

// values += the blocks, at the places of these nodes.
template <int kNodes>
[[gnu::noipa]] void scatter(const ElementBlocks<kNodes>& blocks, const typename ElementOffsets<kNodes>::Nodes& nodes,
                            const ElementOffsets<kNodes>& offsets, const BlockPattern& pattern, double* values) {
  for (std::size_t a = 0; a < kNodes; ++a)
    pattern.add(nodes[a], nodes[a], pattern.symmetric() ? 0 : pattern.offset(nodes[a], nodes[a]), blocks[a][a], values);
  int pair = 0;
  for (std::size_t j = 0; j < kNodes; ++j)
    for (std::size_t i = j + 1; i < kNodes; ++i, ++pair) {
      const int a = nodes[i], b = nodes[j];
      const Mat3& block = blocks[i][j];
      if (!pattern.symmetric()) {
        pattern.add(a, b, pattern.offset(a, b), block, values);
        pattern.add(b, a, pattern.offset(b, a), blocks[j][i], values);
      } else if (a > b) {
        pattern.add(a, b, offsets[pair], block, values);
      } else {
        pattern.add(b, a, offsets[pair], block.transpose(), values);
      }
    }
}

// scatter() of one lane of a symmetric batch.
template <int kNodes>
[[gnu::noipa]] void scatter_lane(const ElementBlocks<kNodes, Batch>& blocks, int lane,
                                 const typename ElementOffsets<kNodes>::Nodes& nodes,
                                 const ElementOffsets<kNodes>& offsets, const BlockPattern& pattern, double* values) {
  constexpr int kNext = Batch::kLanes;  // from an entry of a block to the next
  const auto entries = [&](std::size_t a, std::size_t b) {
    return reinterpret_cast<const double*>(&blocks[a][b]) + lane;
  };
  for (std::size_t a = 0; a < kNodes; ++a) pattern.add_free_diagonal(nodes[a], entries(a, a), kNext, 3 * kNext, values);
  int pair = 0;
  for (std::size_t j = 0; j < kNodes; ++j)
    for (std::size_t i = j + 1; i < kNodes; ++i, ++pair) {
      const bool is_below = nodes[i] > nodes[j];  // else its transpose is
      pattern.add_free(is_below ? nodes[j] : nodes[i], offsets[pair], entries(i, j), is_below ? kNext : 3 * kNext,
                       is_below ? 3 * kNext : kNext, values);
    }
}

// Of one element of a batch.
template <int kNodes>
void take_lane(const ElementBlocks<kNodes, Batch>& blocks, bool symmetric, int lane, ElementBlocks<kNodes>& out) {
  for (std::size_t a = 0; a < kNodes; ++a)
    for (std::size_t b = 0; b < kNodes; ++b)
      if (!symmetric || b <= a)
        for (int i = 0; i < 9; ++i) out[a][b](i) = blocks[a][b](i)[lane];
}

// sum_a G_a G_a^T / s_a (6x6, 1/m^2), where G_a maps the displacement of node a to the Voigt strain in material axes
// and s_a are the nodes' shares of the mass.
template <int kNodes>
Mat6 strain_gram(const ElementPoint<kNodes>& point,
                 const std::array<double, static_cast<std::size_t>(kNodes)>& shares) {
  Eigen::Matrix<double, 6, 3 * kNodes> G;
  for (int a = 0; a < kNodes; ++a) {
    const Vec3 g = a == 0 ? Vec3(-point.B.colwise().sum()) : Vec3(point.B.row(a - 1));
    G.template middleCols<3>(3 * a) << g[0], 0, 0, 0, g[1], 0, 0, 0, g[2],  //
        g[1], g[0], 0, 0, g[2], g[1], g[2], 0, g[0];
    G.template middleCols<3>(3 * a) /= std::sqrt(shares[stiffness_detail::idx(a)]);
  }
  return G * G.transpose();
}

}  // namespace orthodyn
