// Elements in groups that lie together in space, and the groups in colours: groups of one colour share no node, so that
// loops over them may add to nodes at the same time. Sums at a node run in the order of the colours, whatever the
// number of threads.
#pragma once

#include <vector>

#include "lib/core/parallel.h"
#include "lib/fem/element_mesh.h"

namespace orthodyn {

// The cells of a mesh in an order whose groups are compact: by recursive bisection of their bounding box across its
// longest side.
std::vector<int> by_place(const ElementMesh& mesh, std::vector<int> cells);

class ElementGroups {
 public:
  // Of elements in this order.
  ElementGroups(const ElementMesh& mesh, const std::vector<int>& cells);

  int size() const { return size_; }
  // The elements [begin, end) of a group; begin is a multiple of kElements.
  struct Range {
    int begin, end;
  };
  Range elements(int group) const;
  // Groups by colour.
  const std::vector<std::vector<int>>& colours() const { return colours_; }

  // visit(range) for every group, in parallel, for what is added to nodes: one colour after the other.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const std::vector<int>& groups : colours_)
      parallel_for(static_cast<int>(groups.size()),
                   [&](int i) { visit(elements(groups[static_cast<std::size_t>(i)])); });
  }

  // of_group(range) of every group, in parallel.
  template <class OfGroup>
  auto of_each(OfGroup&& of_group) const {
    std::vector<decltype(of_group(Range{}))> all(static_cast<std::size_t>(size_));
    parallel_for(size_, [&](int group) { all[static_cast<std::size_t>(group)] = of_group(elements(group)); });
    return all;
  }

  // About 10 us of work, ten times the cost of handing a group to another thread. Whole batches.
  static constexpr int kElements = 256;

 private:
  int num_elements_, size_;
  std::vector<std::vector<int>> colours_;
};

}  // namespace orthodyn
