#include "lib/scene/tie_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "lib/fem/surface.h"
#include "lib/fem/ties/mortar.h"
#include "lib/mesh/quadratic.h"
#include "lib/mesh/selection.h"
#include "lib/scene/holders.h"
#include "lib/scene/supports.h"

namespace orthodyn {

const Spec<TieInput>& TieInput::spec() {
  using T = TieInput;
  static const auto s =
      Spec<T>()
          .key("name", &T::name, "Name of its force, the output tie.NAME; default tie_1, tie_2 and so on.")
          .key("first", &T::first, "Surface whose nodes follow the second one: that of the smaller or finer mesh.",
               {.required = true})
          .key("second", &T::second, "Surface that the first one lies on; it may be larger.", {.required = true})
          .key("reach", &T::reach,
               "Largest distance of the two surfaces; default a tenth of the size of the faces of `first`.",
               {.unit = "m", .range = {.low = 0}})
          .check([](const T& tie, const Config& config) {
            if (tie.first == tie.second) config.at("second").fail("is the same surface as `first`");
          });
  return s;
}

namespace {

std::string place_of(const Mesh& mesh, int node) { return Value<Vec3>::yaml(mesh.node(node)); }

std::vector<int> nodes_of(const Mesh& mesh, const std::vector<FaceCorners>& faces) {
  const Cells cells = face_cells(mesh, faces);
  std::vector<int> out;
  for (std::size_t k = 0; k < cells.size(); ++k) out.insert(out.end(), cells[k].begin(), cells[k].end());
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

void require_apart(const TieInput& tie, const Mesh& mesh, const std::vector<FaceCorners>& first,
                   const std::vector<FaceCorners>& second) {
  const std::vector<int> a = nodes_of(mesh, first), b = nodes_of(mesh, second);
  std::vector<int> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  if (!common.empty())
    tie.origin.fail(fmt::format(
        "the surfaces '{}' and '{}' share {} node{}, such as that at {} m; tie surfaces of "
        "different bodies",
        tie.first, tie.second, common.size(), common.size() == 1 ? "" : "s", place_of(mesh, common.front())));
}

Mortar mortar_of(const TieInput& tie, const Mesh& mesh, Warnings& warnings) {
  constexpr double kMostUncovered = 0.02, kRoundOff = 1e-9;
  const auto& first = find_surface(mesh, tie.first, tie.origin);
  const auto& second = find_surface(mesh, tie.second, tie.origin);
  require_apart(tie, mesh, first, second);
  Mortar mortar = tie_surfaces(mesh, first, second, tie.reach);
  const std::string remedy = fmt::format(
      "'{}' must lie on '{}', facing it; swap them if the other one is larger, move the bodies, or set "
      "`reach` to the distance of the surfaces",
      tie.first, tie.second);
  if (mortar.uncovered > kMostUncovered)
    tie.origin.fail(fmt::format("{:.3g} % of the surface '{}' have no counterpart on '{}': {}", 100 * mortar.uncovered,
                                tie.first, tie.second, remedy));
  if (!mortar.no_counterpart.empty())
    tie.origin.fail(fmt::format("the node of '{}' at {} m has no counterpart on '{}': {}", tie.first,
                                place_of(mesh, mortar.no_counterpart.front()), tie.second, remedy));
  if (mortar.uncovered > kRoundOff)
    warnings.push_back(
        fmt::format("{}: {:.2g} % of the surface '{}' have no counterpart on '{}' and are not tied there",
                    tie.origin.where, 100 * mortar.uncovered, tie.first, tie.second));
  return mortar;
}

// Moves tied nodes to their leaders, with a warning for each tie whose nodes move visibly.
void move_tied_nodes(const std::vector<TieInput>& inputs, const TiedSurfaces& tied, Mesh& mesh, Warnings& warnings) {
  constexpr double kTold = 1e-3;  // of the root of the mean area of the faces
  const std::vector<Vec3> before = mesh.nodes;
  move_to_leaders(mesh, tied.ties);
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    double moved = 0;
    for (const TiedNode& node : tied.named[k].nodes)
      moved = std::max(moved, (mesh.node(node.node) - before[static_cast<std::size_t>(node.node)]).norm());
    const auto& faces = mesh.surfaces.at(inputs[k].first);
    if (moved > kTold * std::sqrt(surface_area(mesh, faces) / static_cast<double>(faces.size())))
      warnings.push_back(
          fmt::format("{}: the tied nodes were moved onto '{}', by up to {:.3g} m; make the surfaces meet, or refine "
                      "them where they are curved",
                      inputs[k].origin.where, inputs[k].second, moved));
  }
}

// Whether a held component of a tied node has leaders that are held in the same way, by the sum of their weights.
// Leaders beside a held edge have small weights, whose sum is near zero.
bool hold_alike(const Holders& holders, const TiedNode& tied, std::size_t c) {
  constexpr double kLeast = 0.75;
  if (holders.of(tied.node, c) == Holders::kNone) return true;
  double alike = 0;
  for (const auto& [leader, weight] : tied.leaders)
    if (holders.of(leader, c) == holders.of(tied.node, c)) alike += weight;
  return alike >= kLeast;
}

}  // namespace

TiedSurfaces make_ties(const std::vector<TieInput>& inputs, const std::vector<RigidBody>& rigid, Mesh& mesh,
                       Warnings& warnings) {
  if (inputs.empty() && rigid.empty()) return {};
  TiedSurfaces out;
  std::vector<TiedNode> nodes;
  std::map<int, const TieInput*> tied_by;
  std::vector<const RigidBody*> body_of(mesh.nodes.size(), nullptr);
  for (const RigidBody& body : rigid)
    for (const int node : body.nodes()) body_of[static_cast<std::size_t>(node)] = &body;
  for (const TieInput& input : inputs) {
    NamedTie named{input.name.empty() ? fmt::format("tie_{}", out.named.size() + 1) : input.name, {}};
    for (const NamedTie& other : out.named)
      if (other.name == named.name) input.origin.fail(fmt::format("name: '{}' is used twice among ties", named.name));
    for (TiedNode& tied : mortar_of(input, mesh, warnings).nodes) {
      if (const RigidBody* body = body_of[static_cast<std::size_t>(tied.node)])
        input.origin.fail(
            fmt::format("'{}' has nodes of the rigid region '{}', which cannot follow another surface: "
                        "swap `first` and `second`, or make one rigid region of both",
                        input.first, body->name));
      const auto [other, is_new] = tied_by.emplace(tied.node, &input);
      if (!is_new)
        input.origin.fail(fmt::format(
            "the node of '{}' at {} m is tied already, as one of '{}'; make one tie to a surface that contains both "
            "second surfaces, or swap `first` and `second` of this tie",
            input.first, place_of(mesh, tied.node), other->second->first));
      named.nodes.push_back(tied);
      nodes.push_back(std::move(tied));
    }
    out.named.push_back(std::move(named));
  }
  for (const RigidBody& body : rigid) nodes.insert(nodes.end(), body.followers.begin(), body.followers.end());
  try {
    out.ties = Ties(static_cast<int>(mesh.nodes.size()), std::move(nodes));
  } catch (const ConfigError& e) {
    inputs.back().origin.fail(e.what());
  }
  move_tied_nodes(inputs, out, mesh, warnings);
  return out;
}

void release_tied_nodes(const std::vector<TieInput>& inputs, const TiedSurfaces& tied, const Mesh& mesh,
                        Supports& supports) {
  if (tied.ties.empty()) return;
  const Holders holders(supports);
  for (std::size_t k = 0; k < inputs.size(); ++k)
    for (const TiedNode& node : tied.named[k].nodes)
      for (std::size_t c = 0; c < 3; ++c)
        if (!hold_alike(holders, node, c))
          inputs[k].origin.fail(fmt::format(
              "the node of '{}' at {} m is tied, and its component {} is clamped or moved, but '{}' is not held in the "
              "same way there: clamp or move that surface too, or swap `first` and `second` of the tie",
              inputs[k].first, place_of(mesh, node.node), "xyz"[c], inputs[k].second));
  for (const TiedNode& node : tied.ties.nodes())
    for (std::size_t c = 0; c < 3; ++c) supports.held[3 * static_cast<std::size_t>(node.node) + c] = true;
  for (MovedNodes::Part& part : supports.moved)
    std::erase_if(part.nodes, [&](int node) { return tied.ties.is_tied(node); });
  for (Support& support : supports.named)
    for (std::size_t i = 0; i < support.nodes.size(); ++i)
      if (tied.ties.is_tied(support.nodes[i])) support.held[i] = {false, false, false};
}

}  // namespace orthodyn
