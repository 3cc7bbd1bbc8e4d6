#include "lib/scene/abaqus_turned_nodes.h"

#include <fmt/format.h>

#include <algorithm>

namespace orthodyn {

AbaqusTurnedNodes::AbaqusTurnedNodes(const AbaqusFile& deck, const TetMesh& mesh) {
  for (const AbaqusTransform& transform : deck.transforms) {
    if (transform.is_identity) continue;
    const AbaqusSet* set = find_abaqus(deck.node_sets, transform.set);
    Turned& turned = turned_.emplace_back(Turned{transform.place.line, set == nullptr, {}});
    if (!set) continue;
    // The mesh does not have a set whose nodes belong to no element.
    if (const auto nodes = mesh.node_sets.find(set->name); nodes != mesh.node_sets.end())
      turned.nodes = {nodes->second.begin(), nodes->second.end()};
  }
}

std::string AbaqusTurnedNodes::reason(const std::vector<int>& nodes) const {
  for (const Turned& turned : turned_) {
    const auto count = turned.all
                           ? std::ssize(nodes)
                           : std::count_if(nodes.begin(), nodes.end(), [&](int n) { return turned.nodes.contains(n); });
    if (count == 0) continue;
    const std::string start = fmt::format("*TRANSFORM (line {}) turns ", turned.line);
    return count == std::ssize(nodes)
               ? start + "its directions"
               : start + fmt::format("its directions at {} of its {} nodes", count, nodes.size());
  }
  return "";
}

}  // namespace orthodyn
