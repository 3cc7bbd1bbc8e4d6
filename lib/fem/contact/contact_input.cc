#include "lib/fem/contact/contact_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "lib/core/errors.h"
#include "lib/core/spelling.h"
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

void remove_repeated(NodePairs& pairs) {
  for (auto& [a, b] : pairs)
    if (a > b) std::swap(a, b);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

[[noreturn]] void fail_unknown_surface(const Mesh& mesh, const std::string& name, const SourceLocation& origin) {
  std::vector<std::string> surfaces;
  for (const auto& [known, faces] : mesh.surfaces) surfaces.push_back(known);
  const auto& regions = mesh.region_names;
  std::vector<std::string> all = surfaces;
  all.insert(all.end(), regions.begin(), regions.end());
  origin.fail(fmt::format(
      "the mesh has no surface or region '{}'{} Give a surface ({}), or a region for its whole outer "
      "surface ({})",
      name, did_you_mean(name, all, "."), surfaces.empty() ? "it has none" : join(surfaces), join(regions)));
}

}  // namespace

ContactSurface contact_surface(const Mesh& mesh, const std::string& name, const SourceLocation& origin,
                               std::optional<int> first_middle) {
  const auto& regions = mesh.region_names;
  const auto region = std::find(regions.begin(), regions.end(), name);
  if (mesh.surfaces.contains(name)) return {mesh, find_surface(mesh, name, origin), first_middle};
  if (region == regions.end()) fail_unknown_surface(mesh, name, origin);
  return {mesh, outer_faces(mesh, static_cast<int>(region - regions.begin())), first_middle};
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
  const FaceMiddles middles = joined(first, second);
  const auto place = [&](int point) {
    Vec3 sum = Vec3::Zero();
    middles.for_each_node(point, [&](int node, double weight) { sum += weight * mesh.node(node); });
    return sum;
  };
  const auto fail = [&] {
    origin.fail(
        fmt::format("more than {} pairs of nodes may touch: give `slide`, the largest distance at rest of nodes that "
                    "touch later, or smaller surfaces",
                    kMost));
  };
  const bool is_one = &first == &second;
  NodePairs pairs;
  for (const auto& [a, area_of_a] : first.areas())
    for (const auto& [b, area_of_b] : second.areas()) {
      if (is_one && a >= b) continue;
      if (!slide && (middles.has(a) || middles.has(b))) continue;  // their nodes are coupled without them
      if (slide && (place(a) - place(b)).norm() > *slide) continue;
      middles.for_each_node(a, [&, b = b](int of_a, double) {
        middles.for_each_node(b, [&](int of_b, double) {
          if (of_a != of_b) pairs.emplace_back(of_a, of_b);
        });
      });
      if (pairs.size() <= 4 * kMost) continue;
      remove_repeated(pairs);
      if (pairs.size() > kMost) fail();
    }
  remove_repeated(pairs);
  if (pairs.size() > kMost) fail();
  return pairs;
}

}  // namespace orthodyn
