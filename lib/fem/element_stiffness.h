// Stiffness of an element with n nodes, as n x n blocks of 3x3.
#pragma once

#include <array>

#include "lib/element/batch.h"
#include "lib/element/element.h"
#include "lib/element/tangent_form.h"

namespace orthodyn {

// block[a][b] couples nodes a and b; for symmetric matrices only the blocks with b <= a are used.
template <int kNodes, class T = double>
using ElementBlocks =
    std::array<std::array<Mat3T<T>, static_cast<std::size_t>(kNodes)>, static_cast<std::size_t>(kNodes)>;

namespace stiffness_detail {

constexpr std::size_t idx(int i) { return static_cast<std::size_t>(i); }

// Returns sum_n g[n] A_mn for m = 0, 1, 2, with the 3x3 blocks A_mn of A and the shape gradient g of one node.
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

// Tangent moduli dP/dF in space, acting on the columns of dF.
template <class C, class T>
[[gnu::always_inline]] inline Mat9T<T> moduli_in_space(const TangentFormOf<C, T>& form) {
  Mat9T<T> A = expand(form);
  turn_to_space<T>(form.R, A);
  return A;
}
template <class T>
[[gnu::always_inline]] inline const Mat9T<T>& moduli_in_space(const Mat9T<T>& A) {
  return A;
}

// Adds the stiffness V g_a . A . g_b (N/m) of one point to K_ab for nodes a, b = 1, 2, ..., with the point's volume V,
// tangent moduli A and shape gradients g_a. If `first`, sets K_ab instead. `form`: a TangentFormOf, or A.
template <int kNodes, class Form, class T>
[[gnu::noipa]] void add_point_stiffness(const Form& form, const ElementPoint<kNodes, T>& point, bool symmetric,
                                        bool first, ElementBlocks<kNodes, T>& K) {
  using namespace stiffness_detail;
  const Mat9T<T>& A = moduli_in_space(form);
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

// Sets the blocks of node 0, whose shape function is 1 minus the sum of the others.
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

// sum_a G_a G_a^T / s_a (6x6, 1/m^2), where G_a maps the displacement of node a to the Voigt strain in material axes
// and s_a is the node's share of the element mass.
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
