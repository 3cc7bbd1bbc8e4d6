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

}  // namespace

TiedSurfaces make_ties(const std::vector<TieInput>& inputs, Mesh& mesh, Warnings& warnings) {
  constexpr double kTold = 1e-3;  // of the root of the mean area of the faces
  if (inputs.empty()) return {};
  TiedSurfaces out;
  std::vector<TiedNode> nodes;
  std::map<int, const TieInput*> tied_by;
  double size = 0;
  for (const TieInput& input : inputs) {
    NamedTie named{input.name.empty() ? fmt::format("tie_{}", out.named.size() + 1) : input.name, {}};
    for (const NamedTie& other : out.named)
      if (other.name == named.name) input.origin.fail(fmt::format("name: '{}' is used twice among ties", named.name));
    for (TiedNode& tied : mortar_of(input, mesh, warnings).nodes) {
      const auto [other, is_new] = tied_by.emplace(tied.node, &input);
      if (!is_new)
        input.origin.fail(fmt::format(
            "the node of '{}' at {} m is tied already, as one of '{}'; make one tie to a surface that contains both "
            "second surfaces, or swap `first` and `second` of this tie",
            input.first, place_of(mesh, tied.node), other->second->first));
      named.nodes.push_back(tied.node);
      nodes.push_back(std::move(tied));
    }
    out.named.push_back(std::move(named));
    const auto& faces = find_surface(mesh, input.first, input.origin);
    size = std::max(size, std::sqrt(surface_area(mesh, faces) / static_cast<double>(faces.size())));
  }
  out.ties = Ties(static_cast<int>(mesh.nodes.size()), std::move(nodes));
  const double moved = move_to_leaders(mesh, out.ties);
  if (moved > kTold * size)
    warnings.push_back(fmt::format(
        "{}: the tied nodes were moved onto the second surfaces, by up to {:.3g} m; make the surfaces meet, "
        "or refine them where they are curved",
        inputs.front().origin.where, moved));
  return out;
}

void release_tied_nodes(const std::vector<TieInput>& inputs, const Ties& ties, const Mesh& mesh, Supports& supports) {
  if (ties.empty()) return;
  const auto is_held = [&](int node, std::size_t c) { return supports.held[3 * static_cast<std::size_t>(node) + c]; };
  for (const TiedNode& tied : ties.nodes())
    for (std::size_t c = 0; c < 3; ++c)
      if (is_held(tied.node, c) && std::none_of(tied.leaders.begin(), tied.leaders.end(),
                                                [&](const auto& leader) { return is_held(leader.first, c); }))
        inputs.front().origin.fail(fmt::format(
            "the node at {} m is tied, and its component {} is clamped or moved, but that of the surface that it "
            "follows is not: clamp or move that surface, or swap `first` and `second` of the tie",
            place_of(mesh, tied.node), "xyz"[c]));
  for (const TiedNode& tied : ties.nodes())
    for (std::size_t c = 0; c < 3; ++c) supports.held[3 * static_cast<std::size_t>(tied.node) + c] = true;
  for (MovedNodes::Part& part : supports.moved) std::erase_if(part.nodes, [&](int node) { return ties.is_tied(node); });
  for (Support& support : supports.named)
    for (std::size_t i = 0; i < support.nodes.size(); ++i)
      if (ties.is_tied(support.nodes[i])) support.held[i] = {false, false, false};
}

}  // namespace orthodyn
