// The symbolic part of a sparse Cholesky factorisation P A P^T = L L^T: it depends on the pattern of A only.
//
// A supernode is a set of adjacent columns of L with the same rows below the diagonal. Its columns are stored as one
// dense block, column by column, with a row for each of its columns (of which the upper triangle is unused) and each
// row below. So all arithmetic acts on dense matrices (Ng & Peyton, SIAM J. Sci. Comput. 14, 1993).
#pragma once

#include <vector>

#include "lib/core/pattern.h"

namespace orthodyn {

// Integers in groups: group g has items[begin(g)] to items[end(g) - 1], ascending.
struct Groups {
  std::vector<int> start, items;
  int begin(int g) const { return start[static_cast<std::size_t>(g)]; }
  int end(int g) const { return start[static_cast<std::size_t>(g) + 1]; }
};

struct Supernodes {
  // An update of supernode s by an earlier one, `from`: the rows `begin` to `end` - 1 of its block are columns of s.
  struct Update {
    int from, begin, end;
  };
  // Supernodes `begin` to `end` - 1.
  struct Range {
    int begin, end;
  };
  // An entry of A and its position in the block.
  struct Entry {
    int of_a, in_block;
  };

  std::vector<int> order;           // row of A that is at each row of P A P^T
  bool nested_dissection = false;   // false: minimum degree
  std::vector<int> first_column;    // of each supernode, and n
  Groups rows;                      // rows of P A P^T of each block: its columns come first
  std::vector<std::size_t> blocks;  // start of each block in L, and the size of L
  std::vector<int> parent;          // supernode of the first row below the columns, or -1
  std::vector<Entry> entries;       // of A, by supernode
  std::vector<int> entries_start;
  std::vector<Update> updates;  // by supernode, in ascending order of `from`
  std::vector<int> updates_start;
  int most_rows = 0;  // largest number of rows of a block

  // Subtrees of the elimination tree, which do not depend on each other, and the supernodes above them, ascending.
  std::vector<Range> subtrees;
  std::vector<int> top;

  int count() const { return static_cast<int>(parent.size()); }
  int num_columns(int s) const {
    return first_column[static_cast<std::size_t>(s) + 1] - first_column[static_cast<std::size_t>(s)];
  }
  int num_rows(int s) const { return rows.end(s) - rows.begin(s); }
  const int* rows_of(int s) const { return rows.items.data() + rows.begin(s); }
  std::size_t size() const { return blocks.back(); }  // entries of L, unused ones included
  std::size_t bytes() const;                          // of this object
};

// Precondition: the pattern is symmetric. Throws RunError if memory does not suffice, or if a block has more than 2^31
// entries.
Supernodes find_supernodes(const Pattern& pattern);

}  // namespace orthodyn
