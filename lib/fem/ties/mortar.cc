#include "lib/fem/ties/mortar.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "lib/fem/face_nodes.h"

namespace orthodyn {

namespace {

using Vec2 = Eigen::Vector2d;
using Polygon = std::vector<Vec2>;

// Shape functions and their slopes at natural coordinates (r, s): barycentric (1 - r - s, r, s) on a triangle.
struct ShapeValues {
  Vector N;
  Eigen::Matrix<double, Eigen::Dynamic, 2> slopes;
};

struct TieFace {
  std::vector<int> nodes;
  Eigen::Matrix3Xd X;  // m
  std::size_t corners = 0;
  ShapeValues (*shape)(const Vec2& place) = nullptr;
  bool is_transformed = false;  // corner functions with integrals that are not positive, see transformation()
  Vec3 normal = Vec3::Zero(), low = Vec3::Zero(), high = Vec3::Zero();
  double area = 0;  // m^2

  Vec2 centre() const { return corners == 3 ? Vec2(1.0 / 3, 1.0 / 3) : Vec2(0, 0); }
  double size() const { return std::sqrt(area); }
};

template <Face F>
ShapeValues shape_of(const Vec2& p) {
  constexpr bool kIsTriangle = F::kNodes == 3 || F::kNodes == 6;
  const Vec3 place = kIsTriangle ? Vec3(1 - p[0] - p[1], p[0], p[1]) : Vec3(p[0], p[1], 0);
  return {F::shape(place), F::slopes(place)};
}

std::vector<TieFace> tie_faces(const Mesh& mesh, const std::vector<FaceCorners>& corners) {
  std::vector<TieFace> out;
  for_each_face(mesh, corners, [&]<Face F>(std::span<const int> nodes, const FaceNodes<F>& X) {
    TieFace face;
    face.nodes.assign(nodes.begin(), nodes.end());
    face.X = X;
    face.corners = F::kNodes == 3 || F::kNodes == 6 ? 3 : 4;
    face.shape = shape_of<F>;
    face.is_transformed = F::kNodes == 6 || F::kNodes == 8;
    face.area = area<F>(X);
    Vec3 normal = Vec3::Zero();
    for (const auto& [place, weight] : F::points()) normal += weight * normal_at<F>(X, place);
    face.normal = normal.normalized();
    face.low = X.rowwise().minCoeff();
    face.high = X.rowwise().maxCoeff();
    out.push_back(std::move(face));
  });
  return out;
}

// The integrals of the corner functions of Tri6 and Quad8 are not positive, as the mortar method needs. These functions
// have positive integrals: N_c + sum N_m / 5 over the edges at a corner, and 3/5 N_m at the middle of an edge. A field
// with their coefficients has the nodal values transformation() times the coefficients.
constexpr double kShift = 0.2;

Eigen::MatrixXd transformation(const TieFace& face) {
  const auto n = static_cast<Eigen::Index>(face.nodes.size()), corners = static_cast<Eigen::Index>(face.corners);
  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(n, n);
  if (!face.is_transformed) return T;
  for (Eigen::Index c = 0; c < corners; ++c) {
    const Eigen::Index middle = corners + c;
    T(middle, middle) = 1 - 2 * kShift;
    T(middle, c) = T(middle, (c + 1) % corners) = kShift;
  }
  return T;
}

// A plane at a face, on which faces are projected along its normal.
struct Plane {
  Vec3 origin;
  Eigen::Matrix<double, 3, 2> axes;
  Vec3 normal;

  explicit Plane(const TieFace& face) : normal(face.normal) {
    origin = face.X.rowwise().mean();
    axes.col(0) = normal.unitOrthogonal();
    axes.col(1) = normal.cross(Vec3(axes.col(0)));
  }
  Vec2 project(const Vec3& x) const { return axes.transpose() * (x - origin); }
};

// The corners of a face on a plane, counterclockwise.
Polygon polygon(const TieFace& face, const Plane& plane) {
  Polygon out;
  for (std::size_t c = 0; c < face.corners; ++c) out.push_back(plane.project(face.X.col(static_cast<Eigen::Index>(c))));
  if (face.normal.dot(plane.normal) < 0) std::reverse(out.begin(), out.end());
  return out;
}

double cross(const Vec2& a, const Vec2& b) { return a[0] * b[1] - a[1] * b[0]; }

double area_of(const Polygon& p) {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < p.size(); ++k) sum += cross(p[k] - p[0], p[k + 1] - p[0]) / 2;
  return sum;
}

// The common part of two convex polygons (Sutherland & Hodgman, Commun. ACM 17, 1974).
Polygon common_part(Polygon subject, const Polygon& clip) {
  for (std::size_t k = 0; k < clip.size() && !subject.empty(); ++k) {
    const Vec2 a = clip[k], edge = clip[(k + 1) % clip.size()] - a;
    const auto inside = [&](const Vec2& p) { return cross(edge, p - a); };
    Polygon out;
    for (std::size_t i = 0; i < subject.size(); ++i) {
      const Vec2 &p = subject[i], &next = subject[(i + 1) % subject.size()];
      const double here = inside(p), there = inside(next);
      if (here >= 0) out.push_back(p);
      if ((here > 0 && there < 0) || (here < 0 && there > 0)) out.push_back(p + here / (here - there) * (next - p));
    }
    subject = std::move(out);
  }
  return subject;
}

// The natural coordinates of the point of a face over a point of the plane; empty if Newton's method does not converge.
std::optional<Vec2> place_on(const TieFace& face, const Plane& plane, const Vec2& point) {
  constexpr int kMostIterations = 30;
  constexpr double kRoundOff = 1e-14, kConverged = 1e-10;
  Vec2 place = face.centre(), change = Vec2::Ones();
  for (int k = 0; k < kMostIterations; ++k) {
    const ShapeValues at = face.shape(place);
    const Eigen::Matrix2d slopes = plane.axes.transpose() * face.X * at.slopes;
    change = slopes.inverse() * (point - plane.project(face.X * at.N));
    if (!change.allFinite()) return std::nullopt;
    place += change;
    if (change.norm() < kRoundOff) return place;
    if (place.norm() > 10) return std::nullopt;
  }
  return change.norm() < kConverged ? std::optional(place) : std::nullopt;
}

// Faces of the second surface near a box, found by their places along the longest axis of the surface.
class NearFaces {
 public:
  explicit NearFaces(const std::vector<TieFace>& faces) : faces_(faces) {
    Vec3 low = faces[0].low, high = faces[0].high;
    for (const TieFace& face : faces) {
      low = low.cwiseMin(face.low);
      high = high.cwiseMax(face.high);
    }
    (high - low).maxCoeff(&axis_);
    for (std::size_t k = 0; k < faces.size(); ++k) {
      order_.emplace_back(faces[k].low[axis_], k);
      widest_ = std::max(widest_, faces[k].high[axis_] - faces[k].low[axis_]);
    }
    std::sort(order_.begin(), order_.end());
  }

  template <class Visit>
  void visit(const Vec3& low, const Vec3& high, Visit&& visit) const {
    auto at = std::lower_bound(order_.begin(), order_.end(), std::pair<double, std::size_t>{low[axis_] - widest_, 0});
    for (; at != order_.end() && at->first <= high[axis_]; ++at) {
      const TieFace& face = faces_[at->second];
      if ((face.low.array() <= high.array()).all() && (face.high.array() >= low.array()).all()) visit(face);
    }
  }

 private:
  const std::vector<TieFace>& faces_;
  int axis_ = 0;
  double widest_ = 0;
  std::vector<std::pair<double, std::size_t>> order_;
};

// Sums over the faces of the first surface. D and M: the integrals of a node's multiplier with the functions of the
// first and of the second surface.
class MortarSums {
 public:
  MortarSums(const Mesh& mesh, const std::vector<FaceCorners>& second, std::optional<double> reach)
      : second_(tie_faces(mesh, second)), near_(second_), reach_(reach) {}

  void add(const TieFace& face) {
    const Plane plane(face);
    const Polygon own = polygon(face, plane);
    const double reach = reach_.value_or(kReach * face.size());
    const auto n = static_cast<Eigen::Index>(face.nodes.size());
    const Eigen::MatrixXd to_values = transformation(face);
    std::vector<Sample> samples;
    double covered = 0;
    near_.visit(face.low.array() - reach, face.high.array() + reach, [&](const TieFace& other) {
      if (face.normal.dot(other.normal) > kFacing) return;
      const Polygon part = common_part(own, polygon(other, plane));
      if (part.size() < 3 || area_of(part) < kSmallest * area_of(own)) return;
      if (const auto added = sample(part, face, other, plane, reach, samples)) covered += *added;
    });
    total_area_ += area_of(own);
    covered_area_ += covered;
    for (const int node : face.nodes) diagonal_.try_emplace(node, 0);
    if (covered < kLeastCover * area_of(own)) return;
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n);
    Vector integrals = Vector::Zero(n);
    for (const Sample& s : samples) {
      const Vector N = to_values.transpose() * s.first;
      mass += s.weight * N * N.transpose();
      integrals += s.weight * N;
    }
    // The multipliers psi = A N with the integrals of psi_k N_l = delta_kl integral of N_k.
    const Eigen::MatrixXd A = integrals.asDiagonal() * mass.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
    for (const Sample& s : samples) {
      const Vector psi = s.weight * (A * (to_values.transpose() * s.first));
      for (Eigen::Index k = 0; k < n; ++k)
        for (Eigen::Index j = 0; j < s.second.size(); ++j)
          rows_[node(face, k)][s.other->nodes[static_cast<std::size_t>(j)]] += psi[k] * s.second[j];
    }
    for (Eigen::Index k = 0; k < n; ++k) diagonal_[node(face, k)] += integrals[k];
    remember_edges(face);
  }

  Mortar result() const {
    constexpr double kRoundOff = 1e-14;
    Mortar out;
    const auto is_covered = [&](int node) { return diagonal_.at(node) > 0; };
    for (const auto& [node, integral] : diagonal_) {
      const auto edge = ends_.find(node);
      const bool has_edge = edge != ends_.end();
      if (!is_covered(node) || (has_edge && !(is_covered(edge->second.first) && is_covered(edge->second.second)))) {
        out.no_counterpart.push_back(node);
        continue;
      }
      std::map<int, double> weights;
      const auto add = [&](int of, double share) {
        for (const auto& [leader, value] : rows_.at(of)) weights[leader] += share * value / diagonal_.at(of);
      };
      if (has_edge) {
        add(node, 1 - 2 * kShift);
        add(edge->second.first, kShift);
        add(edge->second.second, kShift);
      } else {
        add(node, 1);
      }
      TiedNode tied{node, {}};
      for (const auto& [leader, weight] : weights)
        if (std::abs(weight) > kRoundOff) tied.leaders.emplace_back(leader, weight);
      out.nodes.push_back(std::move(tied));
    }
    out.uncovered = std::max(0.0, 1 - covered_area_ / total_area_);
    out.gap = gap_;
    return out;
  }

 private:
  static constexpr double kReach = 0.1;        // of a face's size
  static constexpr double kFacing = -0.5;      // largest cosine of the normals of faces that belong together
  static constexpr double kSmallest = 1e-12;   // common part, of a face's area
  static constexpr double kLeastCover = 0.05;  // of a face's area; less counts as nothing

  struct Sample {
    double weight;         // m^2
    Vector first, second;  // values of the shape functions
    const TieFace* other;
  };

  static int node(const TieFace& face, Eigen::Index k) { return face.nodes[static_cast<std::size_t>(k)]; }

  // Adds the integration points of a common part. Returns its area, or nothing if the faces are too far apart there.
  std::optional<double> sample(const Polygon& part, const TieFace& face, const TieFace& other, const Plane& plane,
                               double reach, std::vector<Sample>& samples) {
    std::vector<Sample> own;
    double area = 0, gap = 0;
    for (std::size_t k = 1; k + 1 < part.size(); ++k) {
      const double size = cross(part[k] - part[0], part[k + 1] - part[0]) / 2;
      if (!(size > 0)) continue;
      for (const auto& [L, share] : triangle_points_of_degree_5()) {
        const Vec2 point = L[0] * part[0] + L[1] * part[k] + L[2] * part[k + 1];
        const auto at_first = place_on(face, plane, point), at_second = place_on(other, plane, point);
        if (!at_first || !at_second) return std::nullopt;
        const Vector N = face.shape(*at_first).N, M = other.shape(*at_second).N;
        gap = std::max(gap, (face.X * N - other.X * M).norm());
        own.push_back({size * share, N, M, &other});
      }
      area += size;
    }
    if (gap > reach) return std::nullopt;
    gap_ = std::max(gap_, gap);
    samples.insert(samples.end(), own.begin(), own.end());
    return area;
  }

  void remember_edges(const TieFace& face) {
    if (!face.is_transformed) return;
    for (std::size_t c = 0; c < face.corners; ++c)
      ends_[face.nodes[face.corners + c]] = {face.nodes[c], face.nodes[(c + 1) % face.corners]};
  }

  std::vector<TieFace> second_;
  NearFaces near_;
  std::optional<double> reach_;
  std::map<int, double> diagonal_;             // D, m^2
  std::map<int, std::map<int, double>> rows_;  // M, m^2
  std::map<int, std::pair<int, int>> ends_;    // the corners at both ends of the edge of a middle node
  double covered_area_ = 0, total_area_ = 0, gap_ = 0;
};

}  // namespace

Mortar tie_surfaces(const Mesh& mesh, const std::vector<FaceCorners>& first, const std::vector<FaceCorners>& second,
                    std::optional<double> reach) {
  MortarSums sums(mesh, second, reach);
  for (const TieFace& face : tie_faces(mesh, first)) sums.add(face);
  return sums.result();
}

double move_to_leaders(Mesh& mesh, const Ties& ties) {
  double largest = 0;
  for (const TiedNode& tied : ties.nodes()) {
    Vec3 place = Vec3::Zero();
    for (const auto& [leader, weight] : tied.leaders) place += weight * mesh.node(leader);
    Vec3& node = mesh.nodes[static_cast<std::size_t>(tied.node)];
    largest = std::max(largest, (place - node).norm());
    node = place;
  }
  return largest;
}

}  // namespace orthodyn
