#include "lib/fem/contact/near_features.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <unsupported/Eigen/BVH>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

using Bounds = Eigen::AlignedBox3d;
using Corners = ContactSurface::Corners;

Triangle placed(const Corners& nodes, const NodalVector& x) {
  Triangle out;
  out << x.col(nodes[0]), x.col(nodes[1]), x.col(nodes[2]);
  return out;
}

Segment placed(const std::array<int, 2>& nodes, const NodalVector& x) {
  Segment out;
  out << x.col(nodes[0]), x.col(nodes[1]);
  return out;
}

template <class Columns>
Bounds box_of(const Columns& points) {
  return {points.rowwise().minCoeff(), points.rowwise().maxCoeff()};
}

Bounds grown(const Bounds& box, double by) {
  return {(box.min().array() - by).matrix(), (box.max().array() + by).matrix()};
}

bool has(const Corners& corners, int node) { return std::find(corners.begin(), corners.end(), node) != corners.end(); }

// A tree of those boxes that meet a region, for searches.
class BoxTree {
 public:
  BoxTree(const std::vector<Bounds>& boxes, const Bounds& region) {
    std::vector<int> numbers;
    std::vector<Bounds> kept;
    for (std::size_t k = 0; k < boxes.size(); ++k)
      if (region.intersects(boxes[k])) {
        numbers.push_back(static_cast<int>(k));
        kept.push_back(boxes[k]);
      }
    is_empty_ = numbers.empty();
    if (!is_empty_) tree_.init(numbers.begin(), numbers.end(), kept.begin(), kept.end());
  }

  // visit(number) of each box that may meet `box`
  template <class Visit>
  void for_each_near(const Bounds& box, Visit&& visit) const {
    if (is_empty_) return;
    struct Query {
      const Bounds& box;
      Visit& visit;
      bool intersectVolume(const Bounds& other) const { return box.intersects(other); }
      bool intersectObject(int number) const {
        visit(number);
        return false;
      }
    } query{box, visit};
    Eigen::BVIntersect(tree_, query);
  }

 private:
  Eigen::KdBVH<double, 3, int> tree_;
  bool is_empty_ = true;
};

// The triangles of a surface at the positions x that meet a region.
struct SearchedSurface {
  SearchedSurface(const ContactSurface& s, const NodalVector& at, const Bounds& region)
      : surface(s), x(at), triangles(boxes_of(s.triangles(), at), region) {}

  static std::vector<Bounds> boxes_of(const std::vector<Corners>& all, const NodalVector& x) {
    std::vector<Bounds> out;
    out.reserve(all.size());
    for (const Corners& nodes : all) out.push_back(box_of(placed(nodes, x)));
    return out;
  }

  const ContactSurface& surface;
  const NodalVector& x;
  BoxTree triangles;
};

// The points of a surface that are nearest to a node within the gap, as faces, edges and corners, each with the number
// of times that it counts.
class FeaturesNearNode {
 public:
  FeaturesNearNode(const Vec3& x, double gap) : x_(x), gap_(gap) {}

  // Adds a triangle unless it is beyond the gap.
  void add(const Corners& nodes, const Triangle& triangle) {
    const Vec3 L = nearest_point(x_, triangle);
    if (!((x_ - triangle * L).norm() < gap_)) return;
    count(nodes, triangle, L, 1);
    near_.push_back({nodes, triangle});
  }

  // visit(corners, triangle, L, times). All triangles must have been added.
  template <class Visit>
  void for_each(Visit&& visit) {
    if (near_.size() > 1) subtract_shared();
    for (const auto& [key, feature] : features_)
      if (feature.times != 0) visit(feature.nodes, feature.triangle, feature.L, feature.times);
  }

 private:
  struct Feature {
    Corners nodes;
    Triangle triangle;
    Vec3 L;
    int times;
  };
  struct Near {
    Corners nodes;
    Triangle triangle;
  };
  struct Shared {
    int triangles = 0;
    std::size_t in = 0;  // one of them
  };

  void count(const Corners& nodes, const Triangle& triangle, const Vec3& L, int times) {
    Corners key{-1, -1, -1};
    for (std::size_t k = 0; k < 3; ++k)
      if (L[static_cast<Eigen::Index>(k)] > 0) key[k] = nodes[k];
    std::sort(key.begin(), key.end());
    features_.try_emplace(key, Feature{nodes, triangle, L, 0}).first->second.times += times;
  }

  // An edge of n triangles counts 1 - n times, a corner as often as its triangles and edges are too few.
  void subtract_shared() {
    std::map<std::pair<int, int>, Shared> edges;
    std::map<int, Shared> corners;
    for (std::size_t k = 0; k < near_.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [a, b] = std::minmax(near_[k].nodes[c], near_[k].nodes[(c + 1) % 3]);
        edges[{a, b}].in = corners[near_[k].nodes[c]].in = k;
        ++edges[{a, b}].triangles;
        ++corners[near_[k].nodes[c]].triangles;
      }
    std::map<int, int> of_corner;
    for (const auto& [node, shared] : corners) of_corner[node] = 1 - shared.triangles;
    for (const auto& [edge, shared] : edges) {
      const int surplus = shared.triangles - 1;
      if (surplus == 0) continue;
      of_corner[edge.first] += surplus;
      of_corner[edge.second] += surplus;
      const auto& [nodes, triangle] = near_[shared.in];
      const Eigen::Index a = index_of(nodes, edge.first), b = index_of(nodes, edge.second);
      const Vec3 side = triangle.col(b) - triangle.col(a);
      const double place = std::clamp(side.dot(x_ - triangle.col(a)) / side.squaredNorm(), 0.0, 1.0);
      Vec3 L = Vec3::Zero();
      L[a] = 1 - place;
      L[b] = place;
      count_within_gap(shared.in, L, -surplus);
    }
    for (const auto& [node, times] : of_corner) {
      if (times == 0) continue;
      Vec3 L = Vec3::Zero();
      L[index_of(near_[corners[node].in].nodes, node)] = 1;
      count_within_gap(corners[node].in, L, times);
    }
  }

  void count_within_gap(std::size_t k, const Vec3& L, int times) {
    if ((x_ - near_[k].triangle * L).norm() < gap_) count(near_[k].nodes, near_[k].triangle, L, times);
  }

  static Eigen::Index index_of(const Corners& nodes, int node) {
    return std::find(nodes.begin(), nodes.end(), node) - nodes.begin();
  }

  Vec3 x_;
  double gap_;
  std::vector<Near> near_;
  std::map<Corners, Feature> features_;
};

// The places of the nodes of `own` in a region near the other surface.
void add_nodes(const ContactSurface& own, const SearchedSurface& other, const Bounds& region, double gap,
               std::vector<NearPlace>& out) {
  for (const auto& [node, area] : own.areas()) {
    const Vec3 x = other.x.col(node);
    if (!region.contains(x)) continue;
    std::optional<FeaturesNearNode> features;
    other.triangles.for_each_near(grown({x, x}, gap), [&, node = node](int k) {
      const Corners& nodes = other.surface.triangles()[static_cast<std::size_t>(k)];
      if (has(nodes, node)) return;
      if (!features) features.emplace(x, gap);
      features->add(nodes, placed(nodes, other.x));
    });
    if (!features) continue;
    features->for_each(
        [&, node = node, area = area](const Corners& nodes, const Triangle& triangle, const Vec3& L, int times) {
          out.push_back({{node, nodes[0], nodes[1], nodes[2]}, distance_of(x, triangle, L), times * area});
        });
  }
}

bool share_a_node(const std::array<int, 2>& a, const std::array<int, 2>& b) {
  return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
}

// The places of pairs of edges in a region.
void add_edges(const ContactSurface& first, const ContactSurface& second, const NodalVector& x, const Bounds& region,
               double gap, std::vector<NearPlace>& out) {
  constexpr double kShare = 0.1;      // of the areas of sharp edges, beside those of nodes
  constexpr double kLeast = 1e-3;     // of this share, for edges in plane surfaces: they matter where these are bent
  constexpr double kParallel = 1e-3;  // squared sine of the angle below which edges count less
  constexpr double kNone = 1e-20;
  std::vector<Bounds> boxes;
  boxes.reserve(second.edges().size());
  for (const auto& edge : second.edges()) boxes.push_back(box_of(placed(edge.nodes, x)));
  const BoxTree tree(boxes, region);
  const bool is_one = &first == &second;
  for (std::size_t i = 0; i < first.edges().size(); ++i) {
    const auto& own = first.edges()[i];
    const Segment segment = placed(own.nodes, x);
    if (!region.intersects(box_of(segment))) continue;
    tree.for_each_near(grown(box_of(segment), gap), [&](int k) {
      const auto j = static_cast<std::size_t>(k);
      const auto& other = second.edges()[j];
      if (is_one && (j <= i || share_a_node(own.nodes, other.nodes))) return;
      const Segment opposite = placed(other.nodes, x);
      const NearestPlaces places = nearest_places(segment, opposite);
      const Distance distance = distance_of(segment, opposite, places);
      if (!(distance.r < gap)) return;
      const double lengths = own.length * own.length * other.length * other.length;
      const Vec3 along = segment.col(1) - segment.col(0), across = opposite.col(1) - opposite.col(0);
      if (along.cross(across).squaredNorm() < kNone * lengths) return;
      out.push_back({{own.nodes[0], own.nodes[1], other.nodes[0], other.nodes[1]},
                     distance,
                     kShare * std::max(own.sharpness * other.sharpness, kLeast) * (own.area + other.area) / 2,
                     kParallel * lengths});
    });
  }
}

// An edge of `own` in a region that passes through a triangle of the other surface.
std::optional<int> crossing(const ContactSurface& own, const SearchedSurface& other, const Bounds& region) {
  std::optional<int> found;
  for (const auto& edge : own.edges()) {
    const Segment segment = placed(edge.nodes, other.x);
    if (!region.intersects(box_of(segment))) continue;
    other.triangles.for_each_near(box_of(segment), [&](int k) {
      const Corners& nodes = other.surface.triangles()[static_cast<std::size_t>(k)];
      if (found || has(nodes, edge.nodes[0]) || has(nodes, edge.nodes[1])) return;
      if (pierces(segment, placed(nodes, other.x))) found = edge.nodes[0];
    });
    if (found) break;
  }
  return found;
}

// A node of `own` that is less than half a cell below the other surface.
std::optional<int> node_below(const ContactSurface& own, const ContactSurface& other, const NodalVector& x) {
  const double reach = other.mean_edge() / 2;
  if (!grown(other.box(x), reach).intersects(own.box(x))) return std::nullopt;
  const PlacedSurface placed(other, x, reach);
  for (const auto& [node, area] : own.areas())
    if (placed.touch_of(node, PlacedSurface::AtBoundary::left_out)) return node;
  return std::nullopt;
}

RecoverableError crossing_error(int point, const NodalVector& x) {
  return RecoverableError(
      fmt::format("surfaces touch or cross near [{:.4g}, {:.4g}, {:.4g}] m", x(0, point), x(1, point), x(2, point)));
}

}  // namespace

std::vector<NearPlace> NearFeatures::at(const NodalVector& x) const {
  std::vector<NearPlace> out;
  std::optional<int> crossed;
  if (!is_one()) crossed = node_below(first_, second_, x);
  if (!is_one() && !crossed) crossed = node_below(second_, first_, x);
  if (crossed) throw crossing_error(*crossed, x);
  const Bounds region = grown(first_.box(x), gap_).intersection(grown(second_.box(x), gap_));
  if (region.isEmpty()) return out;
  const SearchedSurface second(second_, x, region);
  std::optional<SearchedSurface> first;
  if (!is_one()) first.emplace(first_, x, region);
  crossed = crossing(first_, second, region);
  if (!crossed && first) crossed = crossing(second_, *first, region);
  if (crossed) throw crossing_error(*crossed, x);
  add_nodes(first_, second, region, gap_, out);
  if (first) add_nodes(second_, *first, region, gap_, out);
  add_edges(first_, second_, x, region, gap_, out);
  for (const NearPlace& place : out)
    if (!(place.distance.r > 0)) throw crossing_error(place.points[0], x);
  return out;
}

}  // namespace orthodyn
