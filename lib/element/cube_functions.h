// Shape functions on the square (D = 2) and the cube (D = 3) [-1, 1]^D, with the coordinates x. Each function belongs
// to the node at c, whose coordinates are -1, 0 or 1 (Zienkiewicz & Taylor 2000, vol. 1, ch. 8):
//
//   multilinear  N = prod_d (1 + c_d x_d)/2; nodes at corners only;
//   Lagrange     N = prod_d n(c_d, x_d)  with  n(-1, x) = x (x - 1)/2,  n(0, x) = 1 - x^2,  n(1, x) = x (x + 1)/2;
//   serendipity  N = prod_d f(c_d, x_d)  with  f(-1, x) = (1 - x)/2,    f(0, x) = 1 - x^2,  f(1, x) = (1 + x)/2,
//                times c . x - (D - 1) at corners; nodes at corners and middles of edges only.
#pragma once

#include "lib/core/types.h"

namespace orthodyn {

template <int D>
using CubeCoordinates = Eigen::Matrix<double, D, 1>;

template <int D>
struct CubeFunction {
  double value;
  CubeCoordinates<D> slopes;
};

inline double line_lagrange(double c, double x) { return c == 0 ? 1 - x * x : x * (x + c) / 2; }
inline double line_lagrange_slope(double c, double x) { return c == 0 ? -2 * x : x + c / 2; }

// The product of functions of one coordinate each, from their values and derivatives.
template <int D>
CubeFunction<D> tensor_product(const CubeCoordinates<D>& values, const CubeCoordinates<D>& derivatives) {
  CubeFunction<D> N{1, derivatives};
  for (int d = 0; d < D; ++d) {
    N.value *= values[d];
    for (int other = 0; other < D; ++other)
      if (other != d) N.slopes[d] *= values[other];
  }
  return N;
}

template <int D>
CubeFunction<D> multilinear(const CubeCoordinates<D>& c, const CubeCoordinates<D>& x) {
  return tensor_product<D>((CubeCoordinates<D>::Ones() + c.cwiseProduct(x)) / 2, c / 2);
}

template <int D>
CubeFunction<D> lagrange(const CubeCoordinates<D>& c, const CubeCoordinates<D>& x) {
  return tensor_product<D>(c.binaryExpr(x, &line_lagrange), c.binaryExpr(x, &line_lagrange_slope));
}

template <int D>
CubeFunction<D> serendipity(const CubeCoordinates<D>& c, const CubeCoordinates<D>& x) {
  CubeCoordinates<D> values, derivatives;
  for (int d = 0; d < D; ++d) {
    values[d] = c[d] == 0 ? 1 - x[d] * x[d] : (1 + c[d] * x[d]) / 2;
    derivatives[d] = c[d] == 0 ? -2 * x[d] : c[d] / 2;
  }
  const CubeFunction<D> N = tensor_product<D>(values, derivatives);
  if ((c.array() == 0).any()) return N;
  const double factor = c.dot(x) - (D - 1);
  return {N.value * factor, N.slopes * factor + N.value * c};
}

// Corners of the cube in the order of a hexahedron's nodes, one per column.
inline Eigen::Matrix<double, 3, 8> cube_corners() {
  Eigen::Matrix<double, 3, 8> all;
  all << -1, 1, 1, -1, -1, 1, 1, -1,  //
      -1, -1, 1, 1, -1, -1, 1, 1,     //
      -1, -1, -1, -1, 1, 1, 1, 1;
  return all;
}

// Nodes of the square, one per column: corners, middles of the edges 01, 12, 23, 30, the centre.
inline const Eigen::Matrix<double, 2, 9>& square_nodes() {
  static const Eigen::Matrix<double, 2, 9> all = (Eigen::Matrix<double, 2, 9>() << -1, 1, 1, -1, 0, 1, 0, -1, 0,  //
                                                  -1, -1, 1, 1, -1, 0, 1, 0, 0)
                                                     .finished();
  return all;
}

}  // namespace orthodyn
