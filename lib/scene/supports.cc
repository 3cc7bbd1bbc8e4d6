#include "lib/scene/supports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace orthodyn {

namespace {

bool wants_reactions(const Scene& scene) {
  return scene.output.reactions || std::any_of(scene.expect.begin(), scene.expect.end(), [](const Expectation& e) {
           return e.quantity.starts_with("reaction.") || e.quantity.starts_with("torque.");
         });
}

// The support that each coordinate belongs to.
class CoordinateOwners {
 public:
  explicit CoordinateOwners(const Mesh& mesh) : mesh_(mesh), owner_(3 * mesh.nodes.size(), -1) {}

  // Adds a clamp or, if `moves`, a motion. Clamps may share coordinates; motions may not.
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
      origin.fail(fmt::format("name: '{}' is not a valid name; use letters, digits, _ and -", name));
    for (const Support& other : supports_)
      if (other.name == name) origin.fail(fmt::format("name: '{}' is used twice among clamps and motions", name));
  }

  [[noreturn]] void fail_twice(const SourceLocation& origin, int node, std::size_t component, int owner) const {
    origin.fail(fmt::format(
        "moves component {} of the node at {} m, but this component already belongs to {}; select other nodes or "
        "components",
        "xyz"[component], Value<Vec3>::yaml(mesh_.nodes[static_cast<std::size_t>(node)]),
        supports_[static_cast<std::size_t>(owner)].name));
  }

  const Mesh& mesh_;
  std::vector<int> owner_;  // index of each coordinate's support; -1 for none
  std::vector<Support> supports_;
};

std::string named(const std::string& given, const char* kind, std::size_t index) {
  return given.empty() ? fmt::format("{}_{}", kind, index + 1) : given;
}

void check_velocity(const Scene& scene, const SupportMotion& given, const Motion& motion) {
  if (scene.mass == MassKind::lumped || motion.has_continuous_velocity()) return;
  given.origin.fail(
      "the velocity may jump at a kink, which with a consistent mass causes an infinite force on neighbouring nodes; "
      "use a smooth_step, or mass: lumped");
}

// For static analysis: the displacements of another motion at `time`, with zero velocity and acceleration. They grow
// linearly during the second before `time` (Parts::loads_at in fem_model.h).
class StillMotion : public Motion {
 public:
  // `time`: when the displacements are complete, s.
  StillMotion(std::shared_ptr<const Motion> places, double time) : places_(std::move(places)), time_(time) {}

  Moved at(double t, const NodalVector& X) const override {
    const NodalVector none = NodalVector::Zero(3, X.cols());
    return {places_->part_of_way(std::clamp(t - (time_ - 1), 0.0, 1.0), time_, X), none, none};
  }
  std::vector<double> kinks() const override { return {}; }
  bool has_continuous_velocity() const override { return true; }

 private:
  std::shared_ptr<const Motion> places_;
  double time_;
};

std::shared_ptr<const Motion> motion_in(const Scene& scene, const SupportMotion& given, const Mesh& mesh,
                                        const std::vector<int>& nodes) {
  NodalVector X(3, std::ssize(nodes));
  for (Eigen::Index i = 0; i < X.cols(); ++i)
    X.col(i) = mesh.nodes[static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)])];
  auto motion = given.motion(scene.time.start, scene.time.end, X);
  if (scene.is_static()) return std::make_shared<StillMotion>(std::move(motion), scene.time.end);
  return motion;
}

}  // namespace

Supports make_supports(const Scene& scene, const Mesh& mesh) {
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
