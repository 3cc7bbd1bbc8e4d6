#include "lib/mesh/node_numbers.h"

#include <algorithm>

namespace orthodyn {

NodeNumbers::NodeNumbers(const std::vector<FileNode>& sorted) : sorted_(sorted) {
  if (sorted.empty()) return;
  first_ = static_cast<std::uint64_t>(sorted.front().tag);
  const std::uint64_t range = static_cast<std::uint64_t>(sorted.back().tag) - first_;
  if (range / 4 > sorted.size()) return;
  table_.assign(range + 1, -1);
  for (std::size_t n = 0; n < sorted.size(); ++n)
    table_[static_cast<std::uint64_t>(sorted[n].tag) - first_] = static_cast<int>(n);
}

int NodeNumbers::operator()(std::int64_t tag) const {
  if (!table_.empty()) {
    const std::uint64_t offset = static_cast<std::uint64_t>(tag) - first_;
    return offset < table_.size() ? table_[offset] : -1;
  }
  const auto before = [](const FileNode& node, std::int64_t t) { return node.tag < t; };
  const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), tag, before);
  return found != sorted_.end() && found->tag == tag ? static_cast<int>(found - sorted_.begin()) : -1;
}

}  // namespace orthodyn
