// The stiffness of an element of n nodes, 3n x 3n as 3x3 blocks, and its way into the matrix.
#pragma once

#include <algorithm>
#include <array>

#include "lib/element/element.h"
#include "lib/element/tangent_form.h"
#include "lib/fem/block_pattern.h"

namespace orthodyn {

// block[a][b]; of a symmetric one block[0][b], b > 0, is not set.
template <int kNodes>
using ElementBlocks = std::array<std::array<Mat3, static_cast<std::size_t>(kNodes)>, static_cast<std::size_t>(kNodes)>;

namespace stiffness_detail {

constexpr std::size_t idx(int i) { return static_cast<std::size_t>(i); }

// sum_n g[n] H(m, n), the three 3x3 blocks of H contracted with the gradient of one node.
[[gnu::always_inline]] inline std::array<Mat3, 3> contract_right(const Mat9& H, const Vec3& g) {
  std::array<Mat3, 3> out;
  for (int m = 0; m < 3; ++m)
    out[idx(m)] = g[0] * H.block<3, 3>(3 * m, 0) + g[1] * H.block<3, 3>(3 * m, 3) +
                  g[2] * H.block<3, 3>(3 * m, 6);
  return out;
}

// The rows and columns of node 0, whose shape function is 1 minus the sum of the others.
template <int kNodes>
[[gnu::always_inline]] inline void complete(ElementBlocks<kNodes>& K, bool symmetric) {
  const auto set_to_minus_sum = [](Mat3& out, auto&& block) {
    for (int i = 0; i < 9; ++i) {
      double sum = block(1)(i);
      for (int b = 2; b < kNodes; ++b) sum += block(b)(i);
      out(i) = -sum;
    }
  };
  for (int a = 1; a < kNodes; ++a) {
    set_to_minus_sum(K[idx(a)][0], [&](int b) -> const Mat3& { return K[idx(a)][idx(b)]; });
    if (!symmetric) set_to_minus_sum(K[0][idx(a)], [&](int b) -> const Mat3& { return K[idx(b)][idx(a)]; });
  }
  set_to_minus_sum(K[0][0], [&](int a) -> const Mat3& { return K[idx(a)][0]; });
}

}  // namespace stiffness_detail

// Sets K to what one point adds to the stiffness: K_ab = V g_a : H : g_b, N/m.
template <int kNodes, class C>
[[gnu::noipa]] void point_stiffness(const TangentFormOf<C>& form, const ElementPoint<kNodes>& point, bool symmetric,
                                       ElementBlocks<kNodes>& K) {
  using namespace stiffness_detail;
  const Mat9 H = point.volume * expand(form);
  for (int b = 1; b < kNodes; ++b) {
    const auto right = contract_right(H, point.B.row(b - 1));
    for (int a = symmetric ? b : 1; a < kNodes; ++a) {
      const auto g = point.B.row(a - 1);
      const Mat3 rotated = g[0] * right[0] + g[1] * right[1] + g[2] * right[2];
      K[idx(a)][idx(b)] = form.R * rotated * form.R.transpose();
      if (symmetric && a > b) K[idx(b)][idx(a)] = K[idx(a)][idx(b)].transpose();
    }
  }
  complete<kNodes>(K, symmetric);
}

// sum += K
template <int kNodes>
void add_blocks(const ElementBlocks<kNodes>& K, bool symmetric, ElementBlocks<kNodes>& sum) {
  for (std::size_t a = 0; a < kNodes; ++a)
    for (std::size_t b = 0; b < kNodes; ++b)
      if (!symmetric || a > 0 || b == 0) sum[a][b] += K[a][b];
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
