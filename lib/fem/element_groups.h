// Elements in groups that lie together in space, and the groups in colours: groups of one colour share no node, so that
// loops over them may add to nodes at the same time. Sums at a node run in the order of the colours, whatever the
// number of threads.
#pragma once

#include <vector>

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

  // Takes a thread some ten microseconds, ten times what it costs to have two of them work together.
  static constexpr int kElements = 256;

 private:
  int num_elements_, size_;
  std::vector<std::vector<int>> colours_;
};

}  // namespace orthodyn
