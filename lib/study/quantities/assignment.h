// One-to-one assignments of rows to columns of a matrix.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace orthodyn {

// The column of each row, all different, with the largest sum of entries. Shortest augmenting paths with potentials
// (Jonker & Volgenant 1987, Computing 38, 325), O(rows^2 columns). Precondition: finite entries, and no more rows than
// columns.
std::vector<Eigen::Index> largest_assignment(const Eigen::MatrixXd& gains);

// The column of each row, ascending, with the smallest sum of entries, by dynamic programming. Infinite entries are not
// allowed ones. Empty if no allowed assignment exists.
std::optional<std::vector<Eigen::Index>> smallest_ascending_assignment(const Eigen::MatrixXd& costs);

}  // namespace orthodyn
