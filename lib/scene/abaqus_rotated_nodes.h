// The nodes at which a *TRANSFORM of an Abaqus input file rotates the directions of displacements and forces.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "lib/mesh/io/abaqus_file.h"

namespace orthodyn {

class AbaqusRotatedNodes {
 public:
  // `mesh`: the mesh of the same file.
  AbaqusRotatedNodes(const AbaqusFile& deck, const Mesh& mesh) {
    for (const AbaqusTransform& transform : deck.transforms) {
      if (transform.is_identity) continue;
      const AbaqusSet* set = find_abaqus(deck.node_sets, transform.set);
      Rotated& rotated = rotated_.emplace_back(Rotated{transform.place.line, set == nullptr, {}});
      if (!set) continue;
      // A set whose nodes belong to no element is not in the mesh.
      if (const auto nodes = mesh.node_sets.find(set->name); nodes != mesh.node_sets.end())
        rotated.nodes = {nodes->second.begin(), nodes->second.end()};
    }
  }

  // Text for messages: which *TRANSFORM applies to nodes of a set, and to how many of them; "" if none.
  std::string reason(const std::vector<int>& nodes) const {
    for (const Rotated& rotated : rotated_) {
      const auto count =
          rotated.all ? std::ssize(nodes)
                      : std::count_if(nodes.begin(), nodes.end(), [&](int n) { return rotated.nodes.contains(n); });
      if (count == 0) continue;
      const std::string start = fmt::format("*TRANSFORM (line {}) rotates the directions at ", rotated.line);
      return count == std::ssize(nodes)
                 ? start + "the nodes, which is not supported"
                 : start + fmt::format("{} of the {} nodes, which is not supported", count, nodes.size());
    }
    return "";
  }

 private:
  struct Rotated {
    int line;
    bool all;  // the node set is not in the file, so any node may be meant
    std::set<int> nodes;
  };
  std::vector<Rotated> rotated_;  // without identity transforms
};

}  // namespace orthodyn
