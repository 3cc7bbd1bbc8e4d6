// Divides elements into spatially compact groups, and the groups into colours. Groups of one colour share no node, so
// that a parallel loop over them can add to nodes. The order of the sums at a node is that of the colours and does not
// depend on the number of threads.
#pragma once

#include <vector>

#include "lib/core/parallel.h"
#include "lib/fem/element_mesh.h"

namespace orthodyn {

// Reorders cells so that consecutive groups are compact: recursive bisection of the cells across the longest side of
// their bounding box.
std::vector<int> by_place(const ElementMesh& mesh, std::vector<int> cells);

class ElementGroups {
 public:
  // `cells` in the order of by_place().
  ElementGroups(const ElementMesh& mesh, const std::vector<int>& cells);

  int size() const { return size_; }
  // Index range of a group's elements; begin is a multiple of kElements.
  struct Range {
    int begin, end;
  };
  Range elements(int group) const;
  // Group indices per colour.
  const std::vector<std::vector<int>>& colours() const { return colours_; }

  // Calls visit(range) for every group, in parallel within a colour. Use it for loops that add to nodes.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const std::vector<int>& groups : colours_)
      parallel_for(static_cast<int>(groups.size()),
                   [&](int i) { visit(elements(groups[static_cast<std::size_t>(i)])); });
  }

  // Results of of_group(range) for every group, computed in parallel.
  template <class OfGroup>
  auto of_each(OfGroup&& of_group) const {
    std::vector<decltype(of_group(Range{}))> all(static_cast<std::size_t>(size_));
    parallel_for(size_, [&](int group) { all[static_cast<std::size_t>(group)] = of_group(elements(group)); });
    return all;
  }

  // Elements in a group: 10 us of work, ten times the cost of handing it to a thread. A multiple of Batch::kLanes.
  // Fewer than four such groups are joined into one.
  static constexpr int kElements = 256;

 private:
  int num_elements_, size_;
  std::vector<std::vector<int>> colours_;
};

}  // namespace orthodyn
