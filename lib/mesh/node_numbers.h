// Maps node tags, which may be sparse, to indices.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/mesh/mesh_draft.h"

namespace orthodyn {

// The index of a node is its position in `sorted`, the nodes in ascending order of tags. `sorted` must outlive this.
// Memory is proportional to the number of nodes, whatever the tags are.
class NodeNumbers {
 public:
  explicit NodeNumbers(const std::vector<FileNode>& sorted);

  int operator()(std::int64_t tag) const;  // -1 if there is no such node

 private:
  const std::vector<FileNode>& sorted_;
  std::uint64_t first_ = 0;  // unsigned, so that no difference of tags overflows
  std::vector<int> table_;   // for tags without large gaps
};

}  // namespace orthodyn
