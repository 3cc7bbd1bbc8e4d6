#include "lib/fem/element_stiffness.h"

#include <utility>

namespace orthodyn {

namespace {

constexpr std::array<std::pair<int, int>, 6> kPairs{{{1, 0}, {2, 0}, {3, 0}, {2, 1}, {3, 1}, {3, 2}}};

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

// sum_n g[n] H(m, n), the three 3x3 blocks of H contracted with the gradient of one node.
[[gnu::always_inline]] inline std::array<Mat3, 3> contract_right(const Mat9& H, const Vec3& g) {
  std::array<Mat3, 3> out;
  for (int m = 0; m < 3; ++m)
    out[idx(m)] = g[0] * H.block<3, 3>(3 * m, 0) + g[1] * H.block<3, 3>(3 * m, 3) +
                  g[2] * H.block<3, 3>(3 * m, 6);
  return out;
}

// The rows and columns of node 0, whose shape function is 1 minus the sum of the others.
[[gnu::always_inline]] inline void complete(ElementBlocks& K, bool symmetric) {
  for (int a = 1; a < 4; ++a) {
    K[idx(a)][0] = -(K[idx(a)][1] + K[idx(a)][2] + K[idx(a)][3]);
    if (!symmetric) K[0][idx(a)] = -(K[1][idx(a)] + K[2][idx(a)] + K[3][idx(a)]);
  }
  K[0][0] = -(K[1][0] + K[2][0] + K[3][0]);
}

}  // namespace

template <class C>
ElementBlocks element_stiffness(const TangentFormOf<C>& form, const Tet4& shape, bool symmetric) {
  const Mat9 H = shape.volume * expand(form);
  ElementBlocks K;
  for (int b = 1; b < 4; ++b) {
    const auto right = contract_right(H, shape.B.row(b - 1));
    for (int a = symmetric ? b : 1; a < 4; ++a) {
      const auto g = shape.B.row(a - 1);
      const Mat3 rotated = g[0] * right[0] + g[1] * right[1] + g[2] * right[2];
      K[idx(a)][idx(b)] = form.R * rotated * form.R.transpose();
      if (symmetric && a > b) K[idx(b)][idx(a)] = K[idx(a)][idx(b)].transpose();
    }
  }
  complete(K, symmetric);
  return K;
}

template ElementBlocks element_stiffness(const TangentForm&, const Tet4&, bool);
template ElementBlocks element_stiffness(const TangentFormOf<AnisotropicStiffness>&, const Tet4&, bool);

ElementOffsets::ElementOffsets(const Tet& tet, const BlockPattern& pattern) {
  for (std::size_t k = 0; k < kPairs.size(); ++k) {
    const int a = tet[idx(kPairs[k].first)], b = tet[idx(kPairs[k].second)];
    offset_[k] = pattern.offset(std::max(a, b), std::min(a, b));
  }
}

void scatter(const ElementBlocks& blocks, const Tet& tet, const ElementOffsets& offsets,
             const BlockPattern& pattern, double* values) {
  for (int a = 0; a < 4; ++a) {
    const int node = tet[idx(a)];
    pattern.add(node, node, pattern.symmetric() ? 0 : pattern.offset(node, node),
                blocks[idx(a)][idx(a)], values);
  }
  for (int k = 0; k < 6; ++k) {
    const auto [i, j] = kPairs[idx(k)];
    const int a = tet[idx(i)], b = tet[idx(j)];
    const Mat3& block = blocks[idx(i)][idx(j)];
    if (!pattern.symmetric()) {
      pattern.add(a, b, pattern.offset(a, b), block, values);
      pattern.add(b, a, pattern.offset(b, a), blocks[idx(j)][idx(i)], values);
    } else if (a > b) {
      pattern.add(a, b, offsets[k], block, values);
    } else {
      pattern.add(b, a, offsets[k], block.transpose(), values);
    }
  }
}

Mat6 strain_gram(const Tet4& shape) {
  Eigen::Matrix<double, 6, 12> G;
  for (int a = 0; a < 4; ++a) {
    const Vec3 g = a == 0 ? Vec3(-shape.B.colwise().sum()) : Vec3(shape.B.row(a - 1));
    G.middleCols<3>(3 * a) << g[0], 0, 0, 0, g[1], 0, 0, 0, g[2],  //
        g[1], g[0], 0, 0, g[2], g[1], g[2], 0, g[0];
  }
  return G * G.transpose();
}

}  // namespace orthodyn
