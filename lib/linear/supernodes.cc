#include "lib/linear/supernodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "lib/core/errors.h"
#include "lib/linear/cholmod_view.h"

namespace orthodyn {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Puts each i in [0, size) into the group key(i) in [0, count).
template <class Key>
Groups group_by(int count, int size, const Key& key) {
  Groups groups{std::vector<int>(at(count) + 1), std::vector<int>(at(size))};
  for (int i = 0; i < size; ++i) ++groups.start[at(key(i)) + 1];
  std::partial_sum(groups.start.begin(), groups.start.end(), groups.start.begin());
  std::vector<int> next(groups.start.begin(), groups.start.end() - 1);
  for (int i = 0; i < size; ++i) groups.items[at(next[at(key(i))]++)] = i;
  return groups;
}

struct Ordering {
  std::vector<int> order, column_counts;  // entries of each column of L, the diagonal included
  bool nested_dissection;
};

// The points of a pattern as a graph: the lower triangle of its matrix with one entry for each block of unknowns.
struct PointGraph {
  std::vector<int> first;              // first unknown of each point, and the number of unknowns
  std::vector<int> column_start, row;  // compressed columns
  int size() const { return static_cast<int>(first.size()) - 1; }
};

// Precondition: the unknowns are coordinates of points.
PointGraph graph_of_points(const Pattern& pattern) {
  PointGraph graph;
  std::vector<int> point_of(at(pattern.n));
  for (int i = 0; i < pattern.n; ++i) {
    if (i == 0 || pattern.coordinate[at(i)] / 3 != pattern.coordinate[at(i) - 1] / 3) graph.first.push_back(i);
    point_of[at(i)] = static_cast<int>(graph.first.size()) - 1;
  }
  graph.first.push_back(pattern.n);
  graph.column_start.push_back(0);
  for (int p = 0; p < graph.size(); ++p) {
    const int column = graph.first[at(p)];  // has entries in all rows of the point's unknowns
    int last = -1;
    for (int e = pattern.column_start[at(column)]; e < pattern.column_start[at(column) + 1]; ++e)
      if (const int q = point_of[at(pattern.row[at(e)])]; q != std::exchange(last, q)) graph.row.push_back(q);
    graph.column_start.push_back(static_cast<int>(graph.row.size()));
  }
  return graph;
}

// By CHOLMOD's simplicial analysis, postordered: minimum degree, or nested dissection (METIS) for large systems and
// where it saves many operations.
class Orderer {
 public:
  Orderer() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SIMPLICIAL;
    common_.nmethods = 1;
    common_.postorder = 1;
  }
  ~Orderer() {
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }
  Orderer(const Orderer&) = delete;
  Orderer& operator=(const Orderer&) = delete;

  Ordering order(const Pattern& pattern) {
    bool dissected = pattern.n >= kNestedDissectionFrom && analyze(pattern, CHOLMOD_METIS);  // METIS may be missing
    if (!dissected && analyze(pattern, CHOLMOD_AMD)) dissected = dissect_if_cheaper(pattern);
    if (common_.status == CHOLMOD_OUT_OF_MEMORY)
      throw RunError("the analysis of the matrix does not fit in memory; use a coarser mesh", Reason::out_of_memory);
    if (!factor_) throw RunError(fmt::format("CHOLMOD could not analyse the matrix (status {})", common_.status));
    const auto copy = [&](const void* numbers) {
      return std::vector<int>(static_cast<const int*>(numbers), static_cast<const int*>(numbers) + pattern.n);
    };
    return {copy(factor_->Perm), copy(factor_->ColCount), dissected};
  }

 private:
  // Operations of a factorisation from which another ordering is tried, and the share of them below which it is taken.
  static constexpr double kMany = 1e9, kFewer = 0.75;

  bool analyze(const Pattern& pattern, int method) {
    common_.method[0].ordering = method;
    cholmod_sparse view = cholmod_view(pattern, nullptr);
    factor_ = cholmod_analyze(&view, &common_);
    return factor_ != nullptr;
  }

  // Replaces the analysis by one with nested dissection of the points, whose graph is a ninth of the matrix. Returns
  // false and changes nothing if this saves little.
  bool dissect_if_cheaper(const Pattern& pattern) {
    const double operations = common_.fl;
    if (pattern.coordinate.empty() || operations < kMany) return false;
    std::vector<int> order = dissection_of_points(pattern);
    if (order.empty()) return false;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    cholmod_sparse view = cholmod_view(pattern, nullptr);
    cholmod_factor* found = cholmod_analyze_p(&view, order.data(), nullptr, 0, &common_);
    if (found && common_.fl < kFewer * operations) std::swap(found, factor_);
    else order.clear();
    cholmod_free_factor(&found, &common_);
    return !order.empty();
  }

  // The unknowns in the order of a nested dissection of their points; empty without METIS.
  std::vector<int> dissection_of_points(const Pattern& pattern) {
    PointGraph graph = graph_of_points(pattern);
    common_.method[0].ordering = CHOLMOD_METIS;
    cholmod_sparse view = cholmod_view(pattern, nullptr);
    view.nrow = view.ncol = at(graph.size());
    view.nzmax = graph.row.size();
    view.p = graph.column_start.data();
    view.i = graph.row.data();
    cholmod_factor* found = cholmod_analyze(&view, &common_);
    std::vector<int> order;
    if (found) {
      const int* const points = static_cast<const int*>(found->Perm);
      for (int k = 0; k < graph.size(); ++k)
        for (int i = graph.first[at(points[k])]; i < graph.first[at(points[k]) + 1]; ++i) order.push_back(i);
    }
    cholmod_free_factor(&found, &common_);
    return order;
  }

  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
};

// The entries of P A P^T in its lower triangle; entry e of A is at (row[e], column[e]).
struct Permuted {
  std::vector<int> row, column;
  Groups by_row, by_column;
};

Permuted permute(const Pattern& pattern, const std::vector<int>& order) {
  std::vector<int> to(order.size());
  for (int i = 0; i < pattern.n; ++i) to[at(order[at(i)])] = i;
  Permuted p;
  const int entries = pattern.non_zeros();
  p.row.resize(at(entries));
  p.column.resize(at(entries));
  for (int j = 0; j < pattern.n; ++j)
    for (int e = pattern.column_start[at(j)]; e < pattern.column_start[at(j) + 1]; ++e)
      std::tie(p.column[at(e)], p.row[at(e)]) = std::minmax({to[at(j)], to[at(pattern.row[at(e)])]});
  p.by_row = group_by(pattern.n, entries, [&](int e) { return p.row[at(e)]; });
  p.by_column = group_by(pattern.n, entries, [&](int e) { return p.column[at(e)]; });
  return p;
}

// Parent of each column in the elimination tree: the row of its first entry below the diagonal of L; -1 for a root.
// Liu's algorithm (SIAM J. Matrix Anal. Appl. 11, 1990) with path compression.
std::vector<int> elimination_tree(const Permuted& p, int n) {
  std::vector<int> parent(at(n), -1), ancestor(at(n), -1);
  for (int i = 0; i < n; ++i)
    for (int e = p.by_row.begin(i); e < p.by_row.end(i); ++e)
      for (int j = p.column[at(p.by_row.items[at(e)])], next; j != -1 && j < i; j = next) {
        next = std::exchange(ancestor[at(j)], i);
        if (next == -1) parent[at(j)] = i;
      }
  return parent;
}

// Supernodes being merged: neighbours in the order of columns, where the second is the parent of the first.
class Merging {
 public:
  Merging(const Ordering& ordering, const std::vector<int>& tree) : tree_(tree) {
    const int n = static_cast<int>(tree.size());
    std::vector<int> children(at(n));
    for (int p : tree)
      if (p >= 0) ++children[at(p)];
    const auto& counts = ordering.column_counts;
    for (int j = 0; j < n; ++j) {
      const bool same = j > 0 && tree[at(j) - 1] == j && counts[at(j) - 1] == counts[at(j)] + 1 && children[at(j)] == 1;
      if (same) ++groups_.back().columns;
      else groups_.push_back({j, 1, counts[at(j)], 0});
    }
  }

  // First column of each supernode, and n.
  std::vector<int> first_columns() {
    std::vector<Group> merged;  // from the last to the first
    for (std::size_t s = groups_.size(); s-- > 0;) {
      Group group = groups_[s];
      while (!merged.empty() && is_child(group, merged.back()) && pays(group, merged.back())) {
        group = joined(group, merged.back());
        merged.pop_back();
      }
      merged.push_back(group);
    }
    std::vector<int> first;
    for (auto group = merged.rbegin(); group != merged.rend(); ++group) first.push_back(group->first);
    first.push_back(static_cast<int>(tree_.size()));
    return first;
  }

 private:
  struct Group {
    int first, columns, rows;  // rows of the block
    double zeros;              // stored zeros in its columns
  };

  bool is_child(const Group& child, const Group& parent) const {
    const int up = tree_[at(child.first + child.columns - 1)];
    return up >= 0 && up < parent.first + parent.columns;
  }

  static Group joined(const Group& child, const Group& parent) {
    const double zeros = static_cast<double>(child.columns) * (parent.rows + child.columns - child.rows);
    return {child.first, child.columns + parent.columns, child.columns + parent.rows,
            child.zeros + parent.zeros + zeros};
  }

  // Zeros cost arithmetic and memory, but narrow blocks cost more. The limits are CHOLMOD's (docs/decisions.md).
  static bool pays(const Group& child, const Group& parent) {
    const Group both = joined(child, parent);
    const double columns = both.columns, entries = columns * both.rows - columns * (columns - 1) / 2;
    const double share = both.zeros / entries;
    return both.columns <= 4 || (both.columns <= 16 && share < 0.8) || (both.columns <= 48 && share < 0.1) ||
           share < 0.05;
  }

  const std::vector<int>& tree_;
  std::vector<Group> groups_;
};

// Rows of each block: of the entries of A in its columns, and of the children below their columns.
void find_rows(Supernodes& s, const Permuted& p, int n) {
  const int count = static_cast<int>(s.first_column.size()) - 1;
  std::vector<int> supernode_of(at(n)), marked(at(n), -1), first_child(at(count), -1), next_child(at(count), -1);
  for (int k = 0; k < count; ++k)
    std::fill(supernode_of.begin() + s.first_column[at(k)], supernode_of.begin() + s.first_column[at(k) + 1], k);
  s.rows.start = {0};
  auto& rows = s.rows.items;
  for (int k = 0; k < count; ++k) {
    const int first = s.first_column[at(k)], end = s.first_column[at(k) + 1];
    const auto add = [&](int row) {
      if (row >= end && std::exchange(marked[at(row)], k) != k) rows.push_back(row);
    };
    for (int j = first; j < end; ++j) rows.push_back(j);
    const auto below = static_cast<std::ptrdiff_t>(rows.size());
    for (int e = p.by_column.begin(first); e < p.by_column.end(end - 1); ++e) add(p.row[at(p.by_column.items[at(e)])]);
    for (int child = first_child[at(k)]; child >= 0; child = next_child[at(child)])
      for (int r = s.rows.begin(child); r < s.rows.end(child); ++r) add(rows[at(r)]);
    std::sort(rows.begin() + below, rows.end());
    if (rows.size() > at(std::numeric_limits<int>::max()))
      throw RunError("the Cholesky factor has too many rows; use a coarser mesh");
    s.rows.start.push_back(static_cast<int>(rows.size()));
    s.parent.push_back(
        below < static_cast<std::ptrdiff_t>(rows.size()) ? supernode_of[at(rows[at(static_cast<int>(below))])] : -1);
    if (const int up = s.parent.back(); up >= 0) next_child[at(k)] = std::exchange(first_child[at(up)], k);
  }
}

void place_blocks(Supernodes& s) {
  s.blocks = {0};
  for (int k = 0; k < s.count(); ++k) {
    const auto rows = at(s.num_rows(k)), columns = at(s.num_columns(k));
    if (rows * columns > at(std::numeric_limits<int>::max()))
      throw RunError("a block of the Cholesky factor has more than 2^31 entries; use a coarser mesh");
    s.blocks.push_back(s.blocks.back() + rows * columns);
    s.most_rows = std::max(s.most_rows, s.num_rows(k));
  }
}

void place_entries(Supernodes& s, const Permuted& p) {
  s.entries.reserve(p.row.size());
  s.entries_start = {0};
  std::vector<int> position(p.by_row.start.size());  // of each row in the block
  for (int k = 0; k < s.count(); ++k) {
    for (int r = 0; r < s.num_rows(k); ++r) position[at(s.rows_of(k)[r])] = r;
    for (int j = s.first_column[at(k)]; j < s.first_column[at(k) + 1]; ++j)
      for (int e = p.by_column.begin(j); e < p.by_column.end(j); ++e) {
        const int entry = p.by_column.items[at(e)];
        s.entries.push_back({entry, (j - s.first_column[at(k)]) * s.num_rows(k) + position[at(p.row[at(entry)])]});
      }
    s.entries_start.push_back(static_cast<int>(s.entries.size()));
  }
}

// Returns the number of multiplications for each supernode.
std::vector<double> find_updates(Supernodes& s) {
  std::vector<Supernodes::Update> updates;
  std::vector<int> target;
  std::vector<double> work(at(s.count()));
  for (int k = 0; k < s.count(); ++k) {
    const int* rows = s.rows_of(k);
    const double columns = s.num_columns(k), all = s.num_rows(k);
    work[at(k)] += columns * columns * ((all - columns) / 2 + columns / 6);
    int up = s.parent[at(k)];
    for (int begin = s.num_columns(k), end; begin < s.num_rows(k); begin = end) {
      while (rows[begin] >= s.first_column[at(up) + 1]) ++up;
      for (end = begin; end < s.num_rows(k) && rows[end] < s.first_column[at(up) + 1];) ++end;
      updates.push_back({k, begin, end});
      target.push_back(up);
      work[at(up)] += columns * (end - begin) * (all - 0.5 * (begin + end));
    }
  }
  const Groups groups = group_by(s.count(), static_cast<int>(updates.size()), [&](int u) { return target[at(u)]; });
  s.updates_start = groups.start;
  s.updates.reserve(updates.size());
  for (int u : groups.items) s.updates.push_back(updates[at(u)]);
  return work;
}

// Cuts off the largest subtrees with at most a sixteenth of the work.
void find_subtrees(Supernodes& s, const std::vector<double>& work) {
  constexpr double kShare = 1.0 / 16, kLeastWork = 1e5;  // multiplications; less is not worth a thread
  std::vector<double> below = work;                      // work of each subtree
  std::vector<int> first(at(s.count()));                 // first supernode of each subtree
  std::iota(first.begin(), first.end(), 0);
  for (int k = 0; k < s.count(); ++k)
    if (const int up = s.parent[at(k)]; up >= 0) {
      below[at(up)] += below[at(k)];
      first[at(up)] = std::min(first[at(up)], first[at(k)]);
    }
  const double most = std::max(kLeastWork, kShare * std::accumulate(work.begin(), work.end(), 0.0));
  for (int k = s.count() - 1; k >= 0;) {
    const bool is_subtree = below[at(k)] <= most;
    if (is_subtree) s.subtrees.push_back({first[at(k)], k + 1});
    else s.top.push_back(k);
    k = is_subtree ? first[at(k)] - 1 : k - 1;
  }
  std::reverse(s.subtrees.begin(), s.subtrees.end());
  std::reverse(s.top.begin(), s.top.end());
}

}  // namespace

std::size_t Supernodes::bytes() const {
  const std::size_t integers = order.size() + first_column.size() + rows.start.size() + rows.items.size() +
                               parent.size() + 2 * entries.size() + entries_start.size() + 3 * updates.size() +
                               updates_start.size();
  return integers * sizeof(int) + blocks.size() * sizeof(std::size_t);
}

Supernodes find_supernodes(const Pattern& pattern) {
  const Ordering ordering = Orderer().order(pattern);
  const Permuted permuted = permute(pattern, ordering.order);
  Supernodes s;
  s.order = ordering.order;
  s.nested_dissection = ordering.nested_dissection;
  s.first_column = Merging(ordering, elimination_tree(permuted, pattern.n)).first_columns();
  find_rows(s, permuted, pattern.n);
  place_blocks(s);
  place_entries(s, permuted);
  find_subtrees(s, find_updates(s));
  return s;
}

}  // namespace orthodyn
