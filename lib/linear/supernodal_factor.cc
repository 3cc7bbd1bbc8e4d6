#include "lib/linear/supernodal_factor.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <type_traits>

#include "lib/core/parallel.h"
#include "lib/linear/unit_scale.h"

namespace orthodyn {

namespace {

// Brings the largest number near 1, which keeps float within its range. A power of two, so nothing is rounded; 1 for
// double.
template <class T>
double scale_for(const double* numbers, std::size_t size) {
  if constexpr (std::is_same_v<T, double>) return 1;
  double largest = 0;
  for (std::size_t i = 0; i < size; ++i) largest = std::max(largest, std::abs(numbers[i]));
  return 1 / nearest_power_of_two(largest);
}

}  // namespace

template <class T>
SupernodalFactor<T>::SupernodalFactor(const Supernodes& supernodes)
    : supernodes_(supernodes),
      values_(supernodes.size() + DenseBlocks<T>::kPadding),
      workspaces_(1),
      y_(supernodes.order.size()),
      below_(static_cast<std::size_t>(supernodes.most_rows)) {}

template <class T>
std::size_t SupernodalFactor<T>::bytes(const Supernodes& supernodes) {
  const auto n = supernodes.order.size(), rows = static_cast<std::size_t>(supernodes.most_rows);
  return (supernodes.size() + n + rows) * sizeof(T) + (n + 2 * rows) * sizeof(int);
}

template <class T>
bool SupernodalFactor<T>::factor(const double* values) {
  scale_ = scale_for<T>(values, supernodes_.entries.size());
  std::atomic<bool> positive = true;
  const auto factor_subtree = [&](const Supernodes::Range& subtree, Workspace& workspace) {
    for (int s = subtree.begin; s < subtree.end && positive; ++s)
      if (!factor_supernode(s, values, workspace)) positive = false;
  };
  const auto& subtrees = supernodes_.subtrees;
  if (loop_threads() == 1) {
    for (const auto& subtree : subtrees) factor_subtree(subtree, workspaces_[0]);
  } else {
    workspaces_.resize(std::max(workspaces_.size(), subtrees.size()));
    parallel_for(static_cast<int>(subtrees.size()), [&](int i) {
      factor_subtree(subtrees[static_cast<std::size_t>(i)], workspaces_[static_cast<std::size_t>(i)]);
    });
  }
  for (const int s : supernodes_.top) positive = positive && factor_top(s, values);
  return positive;
}

template <class T>
bool SupernodalFactor<T>::factor_supernode(int s, const double* values, Workspace& workspace) {
  begin_supernode(s, values, workspace);
  take_updates(s, {0, supernodes_.num_columns(s)}, workspace.position, workspace);
  return finish_supernode(s, workspace);
}

template <class T>
bool SupernodalFactor<T>::factor_top(int s, const double* values) {
  constexpr int kStrip = 48;  // columns
  const int columns = supernodes_.num_columns(s), strips = (columns + kStrip - 1) / kStrip;
  const bool serial = loop_threads() == 1;
  if (!serial) workspaces_.resize(std::max(workspaces_.size(), static_cast<std::size_t>(strips)));
  begin_supernode(s, values, workspaces_[0]);
  const auto& position = workspaces_[0].position;
  parallel_for(strips, [&](int i) {
    auto& workspace = workspaces_[serial ? 0 : static_cast<std::size_t>(i)];
    take_updates(s, {i * kStrip, std::min(columns, (i + 1) * kStrip)}, position, workspace);
  });
  return finish_supernode(s, workspaces_[0]);
}

template <class T>
void SupernodalFactor<T>::begin_supernode(int s, const double* values, Workspace& workspace) {
  const auto at = static_cast<std::size_t>(s);
  T* to = block(s);
  std::fill(to, values_.data() + supernodes_.blocks[at + 1], T(0));
  for (int e = supernodes_.entries_start[at]; e < supernodes_.entries_start[at + 1]; ++e) {
    const auto& entry = supernodes_.entries[static_cast<std::size_t>(e)];
    to[entry.in_block] = static_cast<T>(values[entry.of_a] * scale_);
  }
  workspace.position.resize(supernodes_.order.size());
  for (int r = 0; r < supernodes_.num_rows(s); ++r)
    workspace.position[static_cast<std::size_t>(supernodes_.rows_of(s)[r])] = r;
}

template <class T>
void SupernodalFactor<T>::take_updates(int s, Columns columns, const std::vector<int>& position, Workspace& workspace) {
  const auto at = static_cast<std::size_t>(s);
  const int first = supernodes_.first_column[at];
  workspace.rows.resize(static_cast<std::size_t>(supernodes_.most_rows));
  const auto stride = static_cast<std::size_t>(supernodes_.num_rows(s));
  for (int u = supernodes_.updates_start[at]; u < supernodes_.updates_start[at + 1]; ++u) {
    const auto& update = supernodes_.updates[static_cast<std::size_t>(u)];
    const int* from = supernodes_.rows_of(update.from);
    const int* begin = std::lower_bound(from + update.begin, from + update.end, first + columns.begin);
    const int* end = std::lower_bound(begin, from + update.end, first + columns.end);
    if (begin == end) continue;
    const int num_rows = supernodes_.num_rows(update.from), below = static_cast<int>(from + num_rows - begin);
    for (int r = 0; r < below; ++r)
      workspace.rows[static_cast<std::size_t>(r)] = position[static_cast<std::size_t>(begin[r])];
    workspace.dense.subtract_product(below, static_cast<int>(end - begin), supernodes_.num_columns(update.from),
                                     block(update.from) + (begin - from), static_cast<std::size_t>(num_rows),
                                     {block(s), stride, workspace.rows.data(), workspace.rows.data()});
  }
}

template <class T>
bool SupernodalFactor<T>::finish_supernode(int s, Workspace& workspace) {
  const int rows = supernodes_.num_rows(s);
  return workspace.dense.factor(rows, supernodes_.num_columns(s), block(s), static_cast<std::size_t>(rows));
}

template <class T>
void SupernodalFactor<T>::solve(const ConstVectorRef& b, VectorRef x) {
  const auto& order = supernodes_.order;
  const double scale = scale_for<T>(b.data(), order.size());
  for (std::size_t i = 0; i < order.size(); ++i) y_[i] = static_cast<T>(b[order[i]] * scale);
  for (int s = 0; s < supernodes_.count(); ++s) {
    const int m = supernodes_.num_rows(s), n = supernodes_.num_columns(s);
    const int* rows = supernodes_.rows_of(s);
    std::fill(below_.begin(), below_.begin() + (m - n), T(0));
    DenseBlocks<T>::solve_forward(m, n, block(s), static_cast<std::size_t>(m), y_.data() + rows[0], below_.data());
    for (int i = n; i < m; ++i) y_[static_cast<std::size_t>(rows[i])] -= below_[static_cast<std::size_t>(i - n)];
  }
  for (int s = supernodes_.count() - 1; s >= 0; --s) {
    const int m = supernodes_.num_rows(s), n = supernodes_.num_columns(s);
    const int* rows = supernodes_.rows_of(s);
    for (int i = n; i < m; ++i) below_[static_cast<std::size_t>(i - n)] = y_[static_cast<std::size_t>(rows[i])];
    DenseBlocks<T>::solve_backward(m, n, block(s), static_cast<std::size_t>(m), y_.data() + rows[0], below_.data());
  }
  for (std::size_t i = 0; i < order.size(); ++i) x[order[i]] = static_cast<double>(y_[i]) * (scale_ / scale);
}

template class SupernodalFactor<double>;
template class SupernodalFactor<float>;

}  // namespace orthodyn
