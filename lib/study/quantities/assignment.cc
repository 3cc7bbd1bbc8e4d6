#include "lib/study/quantities/assignment.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orthodyn {

namespace {

constexpr double kNotAllowed = std::numeric_limits<double>::infinity();
constexpr Eigen::Index kUnassigned = -1;

// Assigns one row after the other. `price` of columns and `offset` of rows are the dual variables: all reduced costs
// cost - offset - price are non-negative, and 0 for assigned pairs.
class ShortestPaths {
 public:
  explicit ShortestPaths(const Eigen::MatrixXd& costs)
      : costs_(costs),
        offset_(Eigen::VectorXd::Zero(costs.rows())),
        price_(Eigen::VectorXd::Zero(costs.cols())),
        row_of_(static_cast<std::size_t>(costs.cols()), kUnassigned) {}

  std::vector<Eigen::Index> solve() {
    for (Eigen::Index row = 0; row < costs_.rows(); ++row) add(row);
    std::vector<Eigen::Index> out(static_cast<std::size_t>(costs_.rows()));
    for (Eigen::Index c = 0; c < costs_.cols(); ++c)
      if (row_of(c) != kUnassigned) out[static_cast<std::size_t>(row_of(c))] = c;
    return out;
  }

 private:
  Eigen::Index& row_of(Eigen::Index column) { return row_of_[static_cast<std::size_t>(column)]; }

  // The shortest alternating path from `row` to a free column, and the assignment along it.
  void add(Eigen::Index row) {
    const auto n = static_cast<std::size_t>(costs_.cols());
    std::vector<double> distance(n, kNotAllowed);
    std::vector<Eigen::Index> before(n, kUnassigned);  // the column before on the path; kUnassigned: the path's start
    std::vector<bool> done(n, false);
    std::vector<Eigen::Index> reached;
    Eigen::Index at = row, last = kUnassigned;
    double length = 0;
    for (;;) {
      Eigen::Index next = kUnassigned;
      for (Eigen::Index c = 0; c < costs_.cols(); ++c) {
        const auto i = static_cast<std::size_t>(c);
        if (done[i]) continue;
        const double via = length + costs_(at, c) - offset_[at] - price_[c];
        if (via < distance[i]) distance[i] = via, before[i] = last;
        if (next == kUnassigned || distance[i] < distance[static_cast<std::size_t>(next)]) next = c;
      }
      length = distance[static_cast<std::size_t>(next)];
      done[static_cast<std::size_t>(next)] = true;
      last = next;
      if (row_of(next) == kUnassigned) break;
      reached.push_back(next);
      at = row_of(next);
    }
    offset_[row] += length;
    for (const Eigen::Index c : reached) {
      const double slack = length - distance[static_cast<std::size_t>(c)];
      price_[c] -= slack, offset_[row_of(c)] += slack;
    }
    for (Eigen::Index c = last; c != kUnassigned;) {
      const Eigen::Index previous = before[static_cast<std::size_t>(c)];
      row_of(c) = previous == kUnassigned ? row : row_of(previous);
      c = previous;
    }
  }

  const Eigen::MatrixXd& costs_;
  Eigen::VectorXd offset_, price_;
  std::vector<Eigen::Index> row_of_;
};

}  // namespace

std::vector<Eigen::Index> largest_assignment(const Eigen::MatrixXd& gains) {
  const Eigen::MatrixXd costs = -gains;
  return ShortestPaths(costs).solve();
}

std::optional<std::vector<Eigen::Index>> smallest_ascending_assignment(const Eigen::MatrixXd& costs) {
  const Eigen::Index rows = costs.rows(), columns = costs.cols();
  // sums(r, c): of the first r rows in the first c columns
  Eigen::MatrixXd sums = Eigen::MatrixXd::Constant(rows + 1, columns + 1, kNotAllowed);
  sums.row(0).setZero();
  for (Eigen::Index r = 1; r <= rows; ++r)
    for (Eigen::Index c = 1; c <= columns; ++c)
      sums(r, c) = std::min(sums(r, c - 1), sums(r - 1, c - 1) + costs(r - 1, c - 1));
  if (!std::isfinite(sums(rows, columns))) return {};
  std::vector<Eigen::Index> out(static_cast<std::size_t>(rows));
  for (Eigen::Index r = rows, c = columns; r > 0; --c)
    if (sums(r, c) < sums(r, c - 1)) out[static_cast<std::size_t>(--r)] = c - 1;
  return out;
}

}  // namespace orthodyn
