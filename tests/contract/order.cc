#include "tests/contract/order.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/types.h"

namespace orthodyn {

double slope(const std::vector<double>& rtols, const std::vector<double>& errors) {
  const auto n = static_cast<Eigen::Index>(rtols.size());
  Eigen::MatrixXd A(n, 2);
  Vector b(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    A.row(i) << std::log(rtols[static_cast<std::size_t>(i)]), 1;
    b[i] = std::log(errors[static_cast<std::size_t>(i)]);
  }
  return A.colPivHouseholderQr().solve(b)[0];
}

void expect_order(int order, const std::function<double(double rtol)>& error) {
  std::vector<double> rtols = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};
  if (order == 1) rtols = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
  std::vector<double> errors;
  for (const double rtol : rtols) errors.push_back(error(rtol));
  const double k = order;
  const double measured = slope(rtols, errors);
  EXPECT_GE(measured, k / (k + 1) - 0.15) << "order " << order << ", errors " << errors[0] << " to " << errors.back();
  EXPECT_LE(measured, 1.2) << "order " << order << ", errors " << errors[0] << " to " << errors.back();
  EXPECT_LE(errors.back(), order == 1 ? 1e-2 : 1e-4) << "order " << order;
}

}  // namespace orthodyn
