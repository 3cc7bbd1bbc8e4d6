#include "lib/fem/block_pattern.h"

#include <algorithm>
#include <limits>

#include "lib/core/errors.h"
#include "lib/fem/subdomain.h"

namespace orthodyn {

namespace {

// Neighbours of each node, including the node, in ascending order. With `lower`, only those >= the node.
class Neighbours {
 public:
  Neighbours(const Cells& cells, const NodePairs& further, int num_nodes, bool lower)
      : start_(static_cast<std::size_t>(num_nodes) + 1, 0) {
    for_each_pair(cells, further, lower, [&](int, int b) { ++start_[static_cast<std::size_t>(b) + 1]; });
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    list_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for_each_pair(cells, further, lower, [&](int a, int b) { list_[next[static_cast<std::size_t>(b)]++] = a; });
    make_unique();
  }

  template <class Visit>
  void visit(int node, Visit&& f) const {
    const auto b = static_cast<std::size_t>(node);
    for (std::size_t k = start_[b]; k < end_[b]; ++k) f(list_[k]);
  }

 private:
  template <class F>
  static void for_each_pair(const Cells& cells, const NodePairs& further, bool lower, F&& f) {
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
      for (const int a : cells[cell])
        for (const int b : cells[cell])
          if (!lower || a >= b) f(a, b);
    for (const auto& [a, b] : further) {
      if (!lower || a >= b) f(a, b);
      if (!lower || b >= a) f(b, a);
      f(a, a), f(b, b);  // copies of other ranks' nodes may have no cell here
    }
  }

  void make_unique() {
    for (std::size_t b = 0; b + 1 < start_.size(); ++b) {
      const auto first = list_.begin() + static_cast<std::ptrdiff_t>(start_[b]);
      const auto last = list_.begin() + static_cast<std::ptrdiff_t>(start_[b + 1]);
      std::sort(first, last);
      end_.push_back(static_cast<std::size_t>(std::unique(first, last) - list_.begin()));
    }
  }

  std::vector<std::size_t> start_, end_;
  std::vector<int> list_;
};

}  // namespace

BlockPattern::BlockPattern(const Cells& cells, const DofMap& dofs, bool symmetric, const NodePairs& further)
    : dofs_(dofs) {
  pattern_.n = dofs.num_dofs_here();
  pattern_.symmetric = symmetric;
  pattern_.column_start.push_back(0);
  NodePairs pairs = dofs.ties().couplings(cells, further);
  pairs.insert(pairs.end(), further.begin(), further.end());
  const Neighbours neighbours(cells, pairs, dofs.num_nodes(), symmetric);
  std::size_t entries = 0;
  const auto for_each_entry = [&](auto&& entry, auto&& column_end) {
    for (int b = 0; b < dofs.num_nodes(); ++b)
      for (const int column : dofs.node(b)) {
        if (column < 0) continue;
        neighbours.visit(b, [&](int a) {
          for (const int row : dofs.node(a))
            if (row >= 0 && (!symmetric || row >= column)) entry(row);
        });
        column_end();
      }
  };
  for_each_entry([&](int) { ++entries; }, [] {});
  if (entries > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw ConfigError("mesh", "the matrix has more than 2^31 entries; use a coarser mesh");
  pattern_.row.reserve(entries);
  for_each_entry([&](int row) { pattern_.row.push_back(row); },
                 [&] { pattern_.column_start.push_back(pattern_.non_zeros()); });
  pattern_.coordinate.reserve(static_cast<std::size_t>(pattern_.n));
  for (int node = 0; node < dofs.num_nodes(); ++node)
    for (int k = 0; k < 3; ++k)
      if (dofs.node(node)[static_cast<std::size_t>(k)] >= 0) pattern_.coordinate.push_back(3 * node + k);
  if (symmetric) find_columns();
}

void BlockPattern::find_columns() {
  columns_.resize(static_cast<std::size_t>(dofs_.num_nodes()));
  for (int node = 0; node < dofs_.num_nodes(); ++node) {
    const auto& dofs = dofs_.node(node);
    if (*std::min_element(dofs.begin(), dofs.end()) < 0) continue;
    const auto first = static_cast<std::size_t>(dofs[0]);
    const int start = pattern_.column_start[first];
    columns_[static_cast<std::size_t>(node)] = {start, pattern_.column_start[first + 1] - start};
  }
}

void BlockPattern::set_share(const Subdomain& subdomain) {
  const auto has_unknown = [&](int node) {
    const auto& dofs = dofs_.node(node);
    return *std::max_element(dofs.begin(), dofs.end()) >= 0;
  };
  const Ranks& ranks = subdomain.ranks();
  PatternShare share{&ranks, dofs_.num_dofs(), 0, 0, {}, 0};
  for (int i = 0; i < dofs_.num_owned_nodes(); ++i)
    if (has_unknown(i)) ++share.owned_points;
  share.first_point = ranks.sum_before(share.owned_points);
  share.unknowns = static_cast<std::int64_t>(ranks.sum(share.owned));

  NodalVector numbers = NodalVector::Zero(3, dofs_.num_nodes());  // integers; doubles are exact up to 2^53
  auto next = static_cast<double>(share.first_point);
  for (int i = 0; i < dofs_.num_owned_nodes(); ++i)
    if (has_unknown(i)) numbers(0, i) = next++;
  subdomain.copy_from_owners(numbers);
  share.row.reserve(static_cast<std::size_t>(dofs_.num_dofs_here()));
  for (const int coordinate : pattern_.coordinate)
    share.row.push_back(3 * static_cast<std::int64_t>(numbers(0, coordinate / 3)) + coordinate % 3);
  pattern_.share = std::make_shared<const PatternShare>(std::move(share));
}

int BlockPattern::offset(int a, int b) const {
  const auto first_free = [&](int node) {
    for (const int dof : dofs_.node(node))
      if (dof >= 0) return dof;
    return -1;
  };
  const int row = first_free(a), column = first_free(b);
  if (row < 0 || column < 0) return 0;
  const auto begin = pattern_.row.begin() + pattern_.column_start[static_cast<std::size_t>(column)];
  const auto end = pattern_.row.begin() + pattern_.column_start[static_cast<std::size_t>(column) + 1];
  return static_cast<int>(std::lower_bound(begin, end, row) - begin);
}

// A block of a symmetric pattern stands for itself and its transpose, which is not stored.
void BlockPattern::add_to_leaders(int a, int b, const Mat3& block, double* values) const {
  dofs_.ties().for_each_leader(a, [&](int i, double of_a) {
    dofs_.ties().for_each_leader(b, [&](int j, double of_b) {
      const Mat3 share = of_a * of_b * block;
      if (!symmetric() || i > j || (i == j && a == b)) add(i, j, offset(i, j), share, values);
      else if (i == j) add(i, i, 0, share + share.transpose(), values);
      else if (a != b) add(j, i, offset(j, i), share.transpose(), values);
    });
  });
}

void BlockPattern::add(int a, int b, int offset, const Mat3& block, double* values) const {
  if (dofs_.ties().is_tied(a) || dofs_.ties().is_tied(b)) return add_to_leaders(a, b, block, values);
  const auto& rows = dofs_.node(a);
  const auto& columns = dofs_.node(b);
  int shift = offset;  // position of a's first row in this column
  for (int c = 0; c < 3; ++c) {
    const int column = columns[static_cast<std::size_t>(c)];
    if (column < 0) continue;
    double* at = values + pattern_.column_start[static_cast<std::size_t>(column)] + shift;
    for (int r = 0; r < 3; ++r) {
      const int row = rows[static_cast<std::size_t>(r)];
      if (row < 0) continue;
      if (symmetric() && row < column) continue;  // above the diagonal of a diagonal block
      *at++ += block(r, c);
    }
    // In the lower triangle, b's next column starts one row lower, so that a's first row moves up. In a diagonal block,
    // each column starts with its diagonal entry.
    if (symmetric() && a != b) --shift;
  }
}

}  // namespace orthodyn
