// From the tags of nodes, which may be sparse and in any order, to indices.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/mesh/mesh_draft.h"

namespace orthodyn {

// Nodes are numbered by ascending tag. The nodes must be sorted and outlive this. Uses memory in
// proportion to their count, whatever the tags are.
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
