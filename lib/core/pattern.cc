#include "lib/core/pattern.h"

namespace orthodyn {

namespace {

// y += A x for the lower triangle of a symmetric matrix.
class SymmetricProduct {
 public:
  SymmetricProduct(const Pattern& pattern, const double* values, const double* x, double* y)
      : pattern_(pattern), values_(values), x_(x), y_(y) {}

  void add_column(int j) {
    const int begin = start(j), end = start(j + 1);
    const double x = x_[j];
    double sum = values_[begin] * x;
    for (int e = begin + 1; e < end; ++e) {
      const int i = row(e);
      sum += values_[e] * x_[i];
      y_[i] += values_[e] * x;
    }
    y_[j] += sum;
  }

  // Columns j to j + 2 with entries in the same rows below them, which are read once for the three.
  void add_three_columns(int j) {
    const double *a = values_ + start(j), *b = values_ + start(j + 1), *c = values_ + start(j + 2);
    const double x = x_[j], y = x_[j + 1], z = x_[j + 2];
    double sum_x = a[0] * x + a[1] * y + a[2] * z, sum_y = a[1] * x + b[0] * y + b[1] * z,
           sum_z = a[2] * x + b[1] * y + c[0] * z;
    const int* rows = pattern_.row.data() + start(j);
    const int count = start(j + 1) - start(j);
    for (int e = 3; e < count; ++e) {
      const int i = rows[e];
      const double ae = a[e], be = b[e - 1], ce = c[e - 2], xi = x_[i];
      sum_x += ae * xi;
      sum_y += be * xi;
      sum_z += ce * xi;
      y_[i] += ae * x + be * y + ce * z;
    }
    y_[j] += sum_x;
    y_[j + 1] += sum_y;
    y_[j + 2] += sum_z;
  }

  // True if columns j to j + 2 belong to one point whose unknowns have entries in the same rows.
  bool is_point(int j) const {
    if (j + 2 >= pattern_.n || pattern_.coordinate.empty()) return false;
    const auto at = static_cast<std::size_t>(j);
    if (pattern_.coordinate[at] / 3 != pattern_.coordinate[at + 2] / 3) return false;
    const int count = start(j + 1) - start(j);
    return count >= 3 && row(start(j) + 1) == j + 1 && row(start(j) + 2) == j + 2 &&
           start(j + 2) - start(j + 1) == count - 1 && start(j + 3) - start(j + 2) == count - 2;
  }

 private:
  int start(int j) const { return pattern_.column_start[static_cast<std::size_t>(j)]; }
  int row(int e) const { return pattern_.row[static_cast<std::size_t>(e)]; }

  const Pattern& pattern_;
  const double *values_, *x_;
  double* y_;
};

}  // namespace

void Pattern::multiply(const double* values, const ConstVectorRef& x, VectorRef y) const {
  if (!symmetric) {
    y = matrix(values) * x;
    return;
  }
  y.setZero();
  SymmetricProduct product(*this, values, x.data(), y.data());
  for (int j = 0; j < n;) {
    const bool three = product.is_point(j);
    if (three) product.add_three_columns(j);
    else product.add_column(j);
    j += three ? 3 : 1;
  }
}

}  // namespace orthodyn
