#include "lib/scene/supports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "lib/fem/motion/component.h"
#include "lib/fem/motion/still_motion.h"

namespace orthodyn {

namespace {

bool wants_reactions(const Scene& scene) {
  return scene.output.reactions || std::any_of(scene.expect.begin(), scene.expect.end(), [](const Expectation& e) {
           return e.quantity.starts_with("reaction.") || e.quantity.starts_with("torque.");
         });
}

// Which support each coordinate belongs to.
class CoordinateOwners {
 public:
  explicit CoordinateOwners(const TetMesh& mesh) : mesh_(mesh), owner_(3 * mesh.nodes.size(), -1) {}

  // Clamps may share coordinates; motions may not.
  void add(const std::string& name, const Selection& selection, const std::vector<int>& nodes,
           const std::array<bool, 3>& components, bool moves) {
    check_name(name, selection.origin);
    const int index = static_cast<int>(supports_.size());
    Support support{name, nodes, std::vector<std::array<bool, 3>>(nodes.size())};
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        if (!components[c]) continue;
        int& owner = owner_[3 * static_cast<std::size_t>(nodes[i]) + c];
        if (owner >= 0 && moves) fail_twice(selection.origin, nodes[i], c, owner);
        support.held[i][c] = owner < 0;
        if (owner < 0) owner = index;
      }
    supports_.push_back(std::move(support));
  }

  std::vector<bool> held() const {
    std::vector<bool> out;
    for (const int owner : owner_) out.push_back(owner >= 0);
    return out;
  }

  std::vector<Support> take() { return std::move(supports_); }

 private:
  void check_name(const std::string& name, const SourceLocation& origin) const {
    const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
    if (name.empty() || !std::all_of(name.begin(), name.end(), plain))
      origin.fail(fmt::format("name: '{}' is no name; use letters, digits, _ and -", name));
    for (const Support& other : supports_)
      if (other.name == name) origin.fail(fmt::format("name: '{}' is used twice among clamps and motions", name));
  }

  [[noreturn]] void fail_twice(const SourceLocation& origin, int node, std::size_t component, int owner) const {
    origin.fail(
        fmt::format("moves {} of the node at {} m, which belongs to {} already; select nodes that do not "
                    "overlap, or other components",
                    "xyz"[component], Value<Vec3>::yaml(mesh_.nodes[static_cast<std::size_t>(node)]),
                    supports_[static_cast<std::size_t>(owner)].name));
  }

  const TetMesh& mesh_;
  std::vector<int> owner_;  // index of the support, -1 for none
  std::vector<Support> supports_;
};

std::string named(const std::string& given, const char* kind, std::size_t index) {
  return given.empty() ? fmt::format("{}_{}", kind, index + 1) : given;
}

void check_velocity(const Scene& scene, const SupportMotion& given, const Motion& motion) {
  if (scene.mass == MassKind::lumped || motion.has_continuous_velocity()) return;
  given.origin.fail(
      "its velocity may jump at a kink, which a consistent mass answers by an infinite force on the "
      "neighbours; use a smooth_step, or mass: lumped");
}

std::shared_ptr<const Motion> motion_in(const Scene& scene, const SupportMotion& given, const TetMesh& mesh,
                                        const std::vector<int>& nodes) {
  NodalVector X(3, std::ssize(nodes));
  for (Eigen::Index i = 0; i < X.cols(); ++i)
    X.col(i) = mesh.nodes[static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)])];
  auto motion = given.motion(scene.time.start, scene.time.end, X);
  if (scene.is_static()) return std::make_shared<StillMotion>(std::move(motion), scene.time.end);
  return motion;
}

}  // namespace

Supports make_supports(const Scene& scene, const TetMesh& mesh) {
  Supports out;
  CoordinateOwners owners(mesh);
  for (std::size_t k = 0; k < scene.clamps.size(); ++k) {
    const Clamp& clamp = scene.clamps[k];
    owners.add(named(clamp.name, "clamp", k), clamp, selected_nodes(clamp, mesh), component_mask(clamp.components),
               false);
  }
  for (std::size_t k = 0; k < scene.motions.size(); ++k) {
    const SupportMotion& given = scene.motions[k];
    auto nodes = selected_nodes(given, mesh);
    auto motion = motion_in(scene, given, mesh, nodes);
    out.moved.push_back({std::move(motion), std::move(nodes), component_mask(given.components)});
    check_velocity(scene, given, *out.moved.back().motion);
    owners.add(named(given.name, "motion", k), given, out.moved.back().nodes, out.moved.back().components, true);
  }
  out.held = owners.held();
  if (wants_reactions(scene)) out.named = owners.take();
  return out;
}

}  // namespace orthodyn
