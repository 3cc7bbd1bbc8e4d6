#include "lib/scene/rigid_regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "lib/scene/holders.h"
#include "lib/scene/scene.h"
#include "lib/scene/supports.h"

namespace orthodyn {

namespace {

struct RegionNodes {
  std::string name, place;
  std::set<int> nodes;
  std::vector<RigidInertia> given;
};

bool share_nodes(const std::set<int>& a, const std::set<int>& b) {
  return std::any_of(a.begin(), a.end(), [&](int node) { return b.contains(node); });
}

// An entry of given inertia describes one region of the mesh.
void require_one_region(const Region& entry, const std::vector<const Region*>& regions) {
  if (const auto count = std::count(regions.begin(), regions.end(), &entry); count > 1)
    entry.origin.fail(fmt::format(
        "rigid: the entry stands for {} regions of the mesh, and each would have this mass; give each region an entry",
        count));
}

std::vector<RegionNodes> rigid_regions(const std::vector<const Region*>& regions, const Mesh& mesh) {
  std::vector<RegionNodes> all(regions.size());
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto r = static_cast<std::size_t>(mesh.region_of[cell]);
    if (regions[r]->rigid.is_rigid) all[r].nodes.insert(mesh.cells[cell].begin(), mesh.cells[cell].end());
  }
  std::vector<RegionNodes> out;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (all[r].nodes.empty()) continue;
    RegionNodes body{mesh.region_names[r], regions[r]->origin.where, std::move(all[r].nodes), {}};
    if (const auto& inertia = regions[r]->rigid.inertia) {
      require_one_region(*regions[r], regions);
      body.given.push_back(*inertia);
    }
    for (auto other = out.begin(); other != out.end();) {
      if (!share_nodes(other->nodes, body.nodes)) {
        ++other;
        continue;
      }
      body.name = other->name + "+" + body.name;
      body.nodes.merge(other->nodes);
      body.given.insert(body.given.end(), other->given.begin(), other->given.end());
      other = out.erase(other);
    }
    out.push_back(std::move(body));
  }
  return out;
}

// The nodes of a body whose three components belong to the same holder, by holder.
std::map<int, std::vector<int>> held_nodes(const RigidBody& body, const Holders& holders) {
  std::map<int, std::vector<int>> out;
  for (const int node : body.nodes()) {
    const int holder = holders.of(node, 0);
    if (holder != Holders::kNone && holder == holders.of(node, 1) && holder == holders.of(node, 2))
      out[holder].push_back(node);
  }
  return out;
}

// Whether something other than `holder` holds a coordinate of the body.
bool is_held_by_another(const RigidBody& body, const Holders& holders, int holder) {
  for (const int node : body.nodes())
    for (std::size_t c = 0; c < 3; ++c)
      if (const int of = holders.of(node, c); of != Holders::kNone && of != holder) return true;
  return false;
}

// Gives the whole force on a body to the first support that has one of its nodes.
void add_to_support(std::vector<Support>& supports, const RigidBody& body) {
  const std::vector<int> nodes = body.nodes();
  const std::set<int> own(nodes.begin(), nodes.end());
  bool is_given = false;
  for (Support& support : supports) {
    bool touches = false;
    for (std::size_t i = 0; i < support.nodes.size(); ++i) {
      if (!own.contains(support.nodes[i])) continue;
      touches = touches || support.held[i][0];
      support.held[i] = {false, false, false};
    }
    if (!touches || is_given) continue;
    support.frames.insert(support.frames.end(), body.frame.begin(), body.frame.end());
    is_given = true;
  }
}

}  // namespace

std::vector<RigidBody> rigid_bodies(const std::vector<const Region*>& regions, const Mesh& mesh) {
  std::vector<RigidBody> out;
  for (RegionNodes& region : rigid_regions(regions, mesh)) {
    out.push_back(
        rigid_body(mesh, {region.nodes.begin(), region.nodes.end()}, std::move(region.name), std::move(region.place)));
    out.back().given = std::move(region.given);
  }
  return out;
}

std::vector<FrameMass> frame_masses(const std::vector<RigidBody>& bodies, const Mesh& mesh) {
  std::vector<FrameMass> out;
  for (const RigidBody& body : bodies)
    if (!body.given.empty()) out.push_back(body.frame_mass(mesh));
  return out;
}

void hold_rigid_bodies(const Scene& scene, const Mesh& mesh, std::vector<RigidBody>& bodies, Supports& supports) {
  if (bodies.empty()) return;
  const Holders holders(supports);
  for (RigidBody& body : bodies) {
    if (!is_held_by_another(body, holders, Holders::kNone)) continue;
    const auto held = held_nodes(body, holders);
    const auto whole =
        std::find_if(held.begin(), held.end(), [&](const auto& entry) { return spans_plane(mesh, entry.second); });
    if (whole == held.end())
      throw ConfigError(body.place,
                        fmt::format("the rigid region '{}' is held in part: a clamp or motion must hold all components "
                                    "of three of its nodes that are not on a line, and then holds the whole body; use "
                                    "joints for bodies that turn or slide",
                                    body.name));
    if (is_held_by_another(body, holders, whole->first))
      throw ConfigError(
          body.place, fmt::format("the rigid region '{}' is held by several clamps and motions; leave one", body.name));
    body.is_held = true;
    for (const int node : body.nodes())
      for (std::size_t c = 0; c < 3; ++c) supports.held[3 * static_cast<std::size_t>(node) + c] = true;
    if (const int motion = Holders::motion(whole->first); motion >= 0) {
      const SupportMotion& given = scene.motions[static_cast<std::size_t>(motion)];
      if (given.displacement)
        given.origin.fail(fmt::format(
            "formulas would deform the rigid region '{}'; give a translation or a rotation with a factor", body.name));
      std::vector<int>& moved = supports.moved[static_cast<std::size_t>(motion)].nodes;
      const std::set<int> known(moved.begin(), moved.end());
      for (const int node : body.nodes())
        if (!known.contains(node)) moved.push_back(node);
    }
    add_to_support(supports.named, body);
  }
}

void require_dynamic(const Scene& scene, const std::vector<RigidBody>& bodies) {
  for (const RigidBody& body : bodies) {
    if (body.is_held || (scene.analysis == Analysis::dynamic && scene.start == Start::rest)) continue;
    throw ConfigError(body.place,
                      fmt::format("the rigid region '{}' is free: free rigid bodies need analysis: dynamic and start: "
                                  "rest; clamp it, or remove `rigid`",
                                  body.name));
  }
}

}  // namespace orthodyn
