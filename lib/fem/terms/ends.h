// Where springs and dashpots are attached, in the words of the input: between two nodes, or from selected nodes
// to the ground.
#pragma once

#include <array>
#include <optional>

#include "lib/fem/terms/link.h"
#include "lib/mesh/selection.h"

namespace orthodyn {

struct Ends : Selection {
  std::optional<std::array<Vec3, 2>> between;  // m: the nodes nearest to two points
  std::optional<Vec3> anchor;                  // m; default each node's own place at rest

  // Each node is tied to its own place: a link without length.
  bool in_place() const { return !between && !anchor; }
  // At least one.
  std::vector<Link> links(const TetMesh& mesh) const;
  NodePairs couplings(const TetMesh& mesh) const;
  void check(const Config& config) const;
};

template <class T>
Spec<T> ends_spec() {
  return selection_spec<T>()
      .key("between", &T::between, "In place of selected nodes: the two nodes nearest to these points.", {.unit = "m"})
      .key("anchor", &T::anchor,
           "The point of the ground that selected nodes are tied to; default each to its own place at rest.",
           {.unit = "m"});
}

}  // namespace orthodyn
