// Fixed-size and dynamic linear algebra types used everywhere.
#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>

namespace orthodyn {

template <class T>
using Vec3T = Eigen::Matrix<T, 3, 1>;
template <class T>
using Mat3T = Eigen::Matrix<T, 3, 3>;

using Vec3 = Vec3T<double>;
using Mat3 = Mat3T<double>;
template <class T>
using Vec6T = Eigen::Matrix<T, 6, 1>;
using Vec6 = Vec6T<double>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vector = Eigen::VectorXd;
using VectorRef = Eigen::Ref<Vector>;
using ConstVectorRef = Eigen::Ref<const Vector>;

// Compressed columns with 32-bit indices, which CHOLMOD, KLU and Eigen all take without a copy.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

// Which second derivative of an energy enters a Newton matrix. The choice affects convergence but not the solution.
enum class TangentKind { exact, gauss_newton };

}  // namespace orthodyn
