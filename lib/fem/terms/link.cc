#include "lib/fem/terms/link.h"

namespace orthodyn {

void Ends::check(const Config& config) const {
  if (count() + between.has_value() != 1)
    config.fail("give exactly one of surface, box, plane, nearest, nodes, region, between");
  if (between && anchor) config.at("anchor").fail("is used with selected nodes only; remove 'anchor' or 'between'");
}

std::vector<Link> Ends::links(const Mesh& mesh) const {
  if (between) {
    const int a = nearest_node(mesh, (*between)[0]), b = nearest_node(mesh, (*between)[1]);
    if (a == b) origin.fail("between: the same node is nearest to both points; give points further apart");
    return {{a, b, Vec3::Zero()}};
  }
  std::vector<Link> out;
  for (const int node : selected_nodes(*this, mesh))
    out.push_back({node, -1, anchor.value_or(mesh.nodes[static_cast<std::size_t>(node)])});
  return out;
}

NodePairs Ends::couplings(const Mesh& mesh) const {
  NodePairs out;
  if (!between) return out;
  for (const Link& link : links(mesh)) out.emplace_back(link.a, link.b);
  return out;
}

}  // namespace orthodyn
