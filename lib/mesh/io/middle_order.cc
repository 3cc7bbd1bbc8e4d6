#include "lib/mesh/io/middle_order.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "lib/mesh/node_numbers.h"

namespace orthodyn {
namespace {

class MiddleSorter {
 public:
  explicit MiddleSorter(std::vector<FileNode> nodes) : nodes_(std::move(nodes)), number_(sorted(nodes_)) {}

  void sort(std::vector<FileCell>& tets) const {
    std::map<Order, int> found;
    for (const FileCell& tet : tets)
      if (const auto order = order_of(tet)) ++found[*order];
    if (found.empty()) return;
    const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
    const Order order = std::max_element(found.begin(), found.end(), fewer)->first;
    for (FileCell& tet : tets) {
      const auto listed = *tet.midsides;
      for (std::size_t e = 0; e < order.size(); ++e) (*tet.midsides)[e] = listed[order[e]];
    }
  }

 private:
  using Order = std::array<std::size_t, 6>;  // for each edge the index in the list

  // The order in one tet. Empty if a node is undefined (an error later) or if one node is nearest to two edges.
  std::optional<Order> order_of(const FileCell& tet) const {
    for (const std::int64_t tag : tet.corners())
      if (number_(tag) < 0) return std::nullopt;
    for (const std::int64_t tag : *tet.midsides)
      if (number_(tag) < 0) return std::nullopt;
    Order order{};
    std::set<std::size_t> taken;
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      const Vec3 midpoint = 0.5 * (at(tet.nodes[kTetEdges[e][0]]) + at(tet.nodes[kTetEdges[e][1]]));
      const auto nearer = [&](std::int64_t a, std::int64_t b) {
        return (at(a) - midpoint).squaredNorm() < (at(b) - midpoint).squaredNorm();
      };
      const auto nearest = std::min_element(tet.midsides->begin(), tet.midsides->end(), nearer);
      order[e] = static_cast<std::size_t>(nearest - tet.midsides->begin());
      if (!taken.insert(order[e]).second) return std::nullopt;
    }
    return order;
  }

  static const std::vector<FileNode>& sorted(std::vector<FileNode>& nodes) {
    std::stable_sort(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.tag < b.tag; });
    return nodes;
  }
  const Vec3& at(std::int64_t tag) const { return nodes_[static_cast<std::size_t>(number_(tag))].x; }

  std::vector<FileNode> nodes_;
  NodeNumbers number_;
};

}  // namespace

void sort_middles(const std::vector<FileNode>& nodes, std::vector<FileCell>& tets) { MiddleSorter(nodes).sort(tets); }

}  // namespace orthodyn
