#include "lib/fem/contact/contact_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "lib/core/errors.h"
#include "lib/mesh/mesh_faces.h"
#include "lib/mesh/selection.h"

namespace orthodyn {

namespace {

// The outer faces of the cells of a region.
std::vector<FaceCorners> outer_faces(const Mesh& mesh, int region) {
  const std::vector<MeshFace> all = sorted_faces(mesh);
  std::vector<FaceCorners> out;
  for (std::size_t k = 0; k < all.size(); k = end_of_face(all, k))
    if (end_of_face(all, k) == k + 1 && mesh.region_of[static_cast<std::size_t>(all[k].cell)] == region)
      out.push_back(all[k].outward());
  return out;
}

}  // namespace

ContactSurface contact_surface(const Mesh& mesh, const std::string& name, const SourceLocation& origin) {
  const auto& regions = mesh.region_names;
  const auto region = std::find(regions.begin(), regions.end(), name);
  if (mesh.surfaces.contains(name) || region == regions.end()) return {mesh, find_surface(mesh, name, origin)};
  return {mesh, outer_faces(mesh, static_cast<int>(region - regions.begin()))};
}

void require_apart(const ContactSurface& first, const ContactSurface& second, const std::array<std::string, 2>& names,
                   const SourceLocation& origin) {
  std::set<int> nodes;
  for (const auto& [node, area] : first.areas()) nodes.insert(node);
  for (const auto& [node, area] : second.areas())
    if (nodes.contains(node))
      origin.fail(fmt::format("the surfaces '{}' and '{}' share nodes; choose surfaces of different bodies", names[0],
                              names[1]));
}

NodePairs contact_couplings(const Mesh& mesh, const ContactSurface& first, const ContactSurface& second,
                            std::optional<double> slide, const SourceLocation& origin) {
  constexpr std::size_t kMost = 1'000'000;
  const bool is_one = &first == &second;
  NodePairs pairs;
  for (const auto& [a, area_of_a] : first.areas())
    for (const auto& [b, area_of_b] : second.areas()) {
      if (is_one && a >= b) continue;
      if (slide && (mesh.node(a) - mesh.node(b)).norm() > *slide) continue;
      pairs.emplace_back(a, b);
      if (pairs.size() > kMost)
        origin.fail(
            fmt::format("more than {} pairs of nodes may touch: give `slide`, the largest distance at rest of "
                        "nodes that touch later, or smaller surfaces",
                        kMost));
    }
  return pairs;
}

}  // namespace orthodyn
