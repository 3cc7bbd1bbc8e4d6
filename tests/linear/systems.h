// Sparse systems with known properties, for the tests of linear solvers.
#pragma once

#include <algorithm>
#include <vector>

#include "lib/core/pattern.h"
#include "tests/material/constants.h"

namespace orthodyn {

// A sparse matrix with its pattern.
struct System {
  Pattern pattern;
  std::vector<double> values;

  Vector multiply(const Vector& x) const {
    Vector y(x.size());
    pattern.multiply(values.data(), x, y);
    return y;
  }
  Eigen::MatrixXd dense() const {
    const Eigen::MatrixXd stored = pattern.matrix(values.data());
    if (!pattern.symmetric) return stored;
    return stored.selfadjointView<Eigen::Lower>();
  }
};

// The non-zero entries and the diagonal of a full matrix, as a sparse matrix.
inline System sparse(const Eigen::MatrixXd& full, bool symmetric) {
  System s;
  s.pattern.n = static_cast<int>(full.rows());
  s.pattern.symmetric = symmetric;
  s.pattern.column_start.push_back(0);
  for (int j = 0; j < s.pattern.n; ++j) {
    for (int i = symmetric ? j : 0; i < s.pattern.n; ++i)
      if (full(i, j) != 0 || i == j) {
        s.pattern.row.push_back(i);
        s.values.push_back(full(i, j));
      }
    s.pattern.column_start.push_back(s.pattern.non_zeros());
  }
  return s;
}

// A random, diagonally dominant matrix; positive definite if symmetric.
inline System random_system(Random& random, int n, double density, bool symmetric) {
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      if (i != j && random.between(0, 1) < density) full(i, j) = random.between(-1, 1);
  if (symmetric) full = Eigen::MatrixXd(full + full.transpose());
  for (int i = 0; i < n; ++i) full(i, i) = 1.1 * full.row(i).cwiseAbs().sum() + random.between(0.1, 1);
  return sparse(full, symmetric);
}

// The seven-point Laplacian on m x m x m points. Its eigenvalues are in (0, 12).
inline System laplacian(int m) {
  System s;
  s.pattern.n = m * m * m;
  s.pattern.column_start.push_back(0);
  const auto entry = [&](int row, double value) {
    s.pattern.row.push_back(row);
    s.values.push_back(value);
  };
  for (int k = 0; k < m; ++k)
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i) {
        const int column = i + m * (j + m * k);
        entry(column, 6);
        if (i + 1 < m) entry(column + 1, -1);
        if (j + 1 < m) entry(column + m, -1);
        if (k + 1 < m) entry(column + m * m, -1);
        s.pattern.column_start.push_back(s.pattern.non_zeros());
      }
  return s;
}

inline double& diagonal(System& s, int i) {
  auto at = static_cast<std::size_t>(s.pattern.column_start[static_cast<std::size_t>(i)]);
  while (s.pattern.row[at] != i) ++at;
  return s.values[at];
}

inline Vector random_vector(Random& random, Eigen::Index n) {
  return Vector::NullaryExpr(n, [&] { return random.between(-1, 1); });
}

// |A x - b| / (|A| |x| + |b|) in the maximum norm. A backward stable solver reaches a few eps n.
inline double backward_error(const System& s, const Vector& x, const Vector& b) {
  Vector row_sums(x.size());
  std::vector<double> sizes;
  for (const double a : s.values) sizes.push_back(std::abs(a));
  s.pattern.multiply(sizes.data(), Vector::Ones(x.size()), row_sums);
  const double scale = row_sums.maxCoeff() * x.lpNorm<Eigen::Infinity>() + b.lpNorm<Eigen::Infinity>();
  return (s.multiply(x) - b).lpNorm<Eigen::Infinity>() / scale;
}

// One Laplacian for each of the three coordinates of m x m x m points. The first and third coordinate of point 0 are
// removed, as by a support.
inline System points(int m) {
  const System scalar = laplacian(m);
  const Eigen::MatrixXd one = scalar.dense();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * one.rows(), 3 * one.rows());
  for (Eigen::Index i = 0; i < one.rows(); ++i)
    for (Eigen::Index j = 0; j < one.rows(); ++j)
      for (int k = 0; k < 3; ++k) all(3 * i + k, 3 * j + k) = one(i, j);
  std::vector<int> kept;
  for (int c = 0; c < all.rows(); ++c)
    if (c != 0 && c != 2) kept.push_back(c);
  System s = sparse(all(kept, kept), true);
  s.pattern.coordinate = kept;
  return s;
}

// The translations of all points along x, y and z, as columns.
inline Eigen::MatrixXd translations(const Pattern& pattern) {
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(pattern.n, 3);
  for (int i = 0; i < pattern.n; ++i) motions(i, pattern.coordinate[static_cast<std::size_t>(i)] % 3) = 1;
  return motions;
}

}  // namespace orthodyn
