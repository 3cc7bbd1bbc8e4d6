#include "lib/fem/contact/contact_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "lib/fem/face_nodes.h"
#include "lib/mesh/mesh_faces.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {

namespace {

// The triangles of a face, as indices of its nodes, and of its middle after these.
const std::vector<std::array<int, 3>>& triangles_of(CellShape shape) {
  static const std::vector<std::array<int, 3>> tri3{{0, 1, 2}};
  static const std::vector<std::array<int, 3>> tri7{{0, 3, 6}, {3, 1, 6}, {1, 4, 6}, {4, 2, 6}, {2, 5, 6}, {5, 0, 6}};
  static const std::vector<std::array<int, 3>> quad4{{0, 1, 2}, {0, 2, 3}};
  static const std::vector<std::array<int, 3>> quad9{{0, 4, 8}, {4, 1, 8}, {1, 5, 8}, {5, 2, 8},
                                                     {2, 6, 8}, {6, 3, 8}, {3, 7, 8}, {7, 0, 8}};
  switch (shape) {
    case CellShape::tri6: return tri7;
    case CellShape::quad4: return quad4;
    case CellShape::quad8:
    case CellShape::quad9: return quad9;
    default: return tri3;
  }
}

Vec3 area_vector(const Triangle& t) { return Vec3(t.col(1) - t.col(0)).cross(Vec3(t.col(2) - t.col(0))) / 2; }

// The angle at a corner, rad.
double angle_at(const Triangle& t, int k) {
  const Vec3 a = t.col((k + 1) % 3) - t.col(k), b = t.col((k + 2) % 3) - t.col(k);
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// The least volume of a cell over the area of its face, times 3 for tetrahedra, whose other corner is above the face.
double least_height(const Mesh& mesh, const std::vector<FaceCorners>& faces) {
  const std::vector<MeshFace> all = sorted_faces(mesh);
  std::vector<double> areas;
  for_each_face(mesh, faces, [&]<Face F>(std::span<const int>, const FaceNodes<F>& X) { areas.push_back(area<F>(X)); });
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto [begin, end] = find_faces(all, faces[i]);
    for (std::size_t k = begin; k < end; ++k) {
      const auto cell = static_cast<std::size_t>(all[k].cell);
      const CellShape shape = mesh.cells.shape(cell);
      const double times = shape == CellShape::tet4 || shape == CellShape::tet10 ? 3 : 1;
      least = std::min(least, times * cell_volume(mesh, cell) / areas[i]);
    }
  }
  return least;
}

NodalVector nodes_at_rest(const Mesh& mesh) {
  NodalVector out(3, std::ssize(mesh.nodes));
  for (Eigen::Index i = 0; i < out.cols(); ++i) out.col(i) = mesh.node(static_cast<int>(i));
  return out;
}

Triangle at_rest(const NodalVector& rest, const ContactSurface::Corners& points) {
  Triangle out;
  out << rest.col(points[0]), rest.col(points[1]), rest.col(points[2]);
  return out;
}

// ContactSurface::Edge::sharpness of the edge of two triangles.
double sharpness_between(const Triangle& a, const Triangle& b) {
  constexpr double kSharp = std::numbers::pi / 6;
  const Vec3 n = area_vector(a).normalized(), m = area_vector(b).normalized();
  const bool is_notch = n.dot(b.rowwise().mean() - a.rowwise().mean()) > 0;
  return is_notch ? 0 : std::pow(std::min(1.0, std::atan2(n.cross(m).norm(), n.dot(m)) / kSharp), 2);
}

}  // namespace

ContactSurface::ContactSurface(const Mesh& mesh, const std::vector<FaceCorners>& faces, std::optional<int> first_middle)
    : middles_(first_middle.value_or(static_cast<int>(mesh.nodes.size()))),
      areas_(contact_areas(mesh, faces, middles_)),
      thickness_(least_height(mesh, faces)) {
  const Cells cells = face_cells(mesh, faces);
  int middle = middles_.first();
  std::map<std::pair<int, int>, std::vector<std::size_t>> uses;  // triangles of an edge
  for (std::size_t k = 0; k < cells.size(); ++k) {
    std::vector<int> points(cells[k].begin(), cells[k].end());
    if (FaceMiddles::has_middle(static_cast<int>(points.size()))) points.push_back(middle++);
    for (const auto& corners : triangles_of(cells.shape(k))) {
      Corners& of = triangles_.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) of[c] = points[static_cast<std::size_t>(corners[c])];
      for (std::size_t c = 0; c < 3; ++c) uses[std::minmax(of[c], of[(c + 1) % 3])].push_back(triangles_.size() - 1);
    }
  }
  NodalVector storage;
  const NodalVector nodes = nodes_at_rest(mesh);
  const NodalVector& rest = middles_.values(nodes, storage);
  double sum = 0;
  const std::map<int, double> area_of(areas_.begin(), areas_.end());
  for (const auto& [edge, of] : uses) {
    const auto& [a, b] = edge;
    const double length = (rest.col(a) - rest.col(b)).norm();
    const double sharpness =
        of.size() == 2 ? sharpness_between(at_rest(rest, triangles_[of[0]]), at_rest(rest, triangles_[of[1]])) : 1;
    edges_.push_back({{a, b}, (area_of.at(a) + area_of.at(b)) / 2, length, sharpness});
    sum += static_cast<double>(of.size()) * length;
    if (of.size() == 1) {
      boundary_edges_.insert(edge);
      boundary_nodes_.insert(edge.first);
      boundary_nodes_.insert(edge.second);
    }
  }
  mean_edge_ = sum / (3 * static_cast<double>(triangles_.size()));
}

bool ContactSurface::is_on_boundary(const Corners& triangle, const Vec3& L) const {
  std::vector<int> nodes;
  for (int k = 0; k < 3; ++k)
    if (L[k] > 0) nodes.push_back(triangle[static_cast<std::size_t>(k)]);
  if (nodes.size() == 1) return boundary_nodes_.contains(nodes[0]);
  return nodes.size() == 2 && boundary_edges_.contains({std::min(nodes[0], nodes[1]), std::max(nodes[0], nodes[1])});
}

Eigen::AlignedBox3d ContactSurface::box(const NodalVector& x) const {
  Eigen::AlignedBox3d box;
  for (const auto& [node, area] : areas_) box.extend(Vec3(x.col(node)));
  return box;
}

std::size_t ContactSurface::bytes() const {
  return areas_.capacity() * sizeof(areas_[0]) + triangles_.capacity() * sizeof(Corners) +
         edges_.capacity() * sizeof(Edge);
}

Vec3 force_on(const ContactSurface& surface, const Term& term, const NodalState& s) {
  NodalVector f = NodalVector::Zero(3, s.x.cols());
  term.add_force(s, f);
  Vec3 sum = Vec3::Zero();
  for (const auto& [point, area] : surface.areas())
    if (!surface.middles().has(point)) sum += f.col(point);
  return sum;
}

FaceMiddles joined(const ContactSurface& first, const ContactSurface& second) {
  FaceMiddles all = first.middles();
  all.append(second.middles());
  return all;
}

PlacedSurface::PlacedSurface(const ContactSurface& surface, const NodalVector& x, double reach)
    : surface_(surface), x_(x), reach_(reach) {
  low_ = high_ = x.col(surface.triangles()[0][0]);
  for (const auto& [node, area] : surface.areas()) {
    low_ = low_.cwiseMin(x.col(node));
    high_ = high_.cwiseMax(x.col(node));
  }
  (high_ - low_).maxCoeff(&axis_);
  order_.reserve(surface.triangles().size());
  for (int k = 0; k < static_cast<int>(surface.triangles().size()); ++k) {
    const Eigen::RowVector3d along = corners(k).row(axis_);
    order_.push_back({along.minCoeff(), k});
    widest_ = std::max(widest_, along.maxCoeff() - along.minCoeff());
  }
  std::sort(order_.begin(), order_.end());
}

Triangle PlacedSurface::corners(int triangle) const {
  const auto& [a, b, c] = surface_.triangles()[static_cast<std::size_t>(triangle)];
  Triangle out;
  out << x_.col(a), x_.col(b), x_.col(c);
  return out;
}

std::optional<Touch> PlacedSurface::touch_of(int point, AtBoundary boundary) const {
  constexpr double kSame = 1e-9;  // distances of triangles that share the nearest point, relative to the reach
  const Vec3 x = x_.col(point);
  if (!((x - low_).minCoeff() >= -reach_ && (high_ - x).minCoeff() >= -reach_)) return std::nullopt;
  struct Found {
    double r;
    int triangle;
    Vec3 L;
  };
  std::vector<Found> found;
  double least = reach_;
  auto at = std::lower_bound(order_.begin(), order_.end(), Placed{x[axis_] - reach_ - widest_, 0});
  for (; at != order_.end() && at->low <= x[axis_] + reach_; ++at) {
    const Triangle t = corners(at->triangle);
    const double sought = least + kSame * reach_;
    if (((t.rowwise().minCoeff() - x).array() > sought).any() || ((x - t.rowwise().maxCoeff()).array() > sought).any())
      continue;
    const Vec3 L = nearest_point(x, t);
    const double r = (x - t * L).norm();
    if (r > sought) continue;
    least = std::min(least, r);
    found.push_back({r, at->triangle, L});
  }
  // Below the surface means against its normal; on an edge or at a corner, against the mean normal of the triangles
  // there, weighted by their angles (Baerentzen & Aanaes, IEEE Trans. Vis. Comput. Graph. 11, 2005).
  Vec3 normal = Vec3::Zero();
  const Found* nearest = nullptr;
  for (const Found& f : found) {
    if (f.r > least + kSame * reach_) continue;
    const Triangle t = corners(f.triangle);
    int corner = -1;
    for (int k = 0; k < 3; ++k)
      if (f.L[k] == 1) corner = k;
    normal += (corner < 0 ? 1.0 : angle_at(t, corner)) * area_vector(t).normalized();
    if (!nearest || f.triangle < nearest->triangle) nearest = &f;
  }
  if (!nearest || !(nearest->r > 0)) return std::nullopt;
  const auto& nodes = surface_.triangles()[static_cast<std::size_t>(nearest->triangle)];
  const Triangle t = corners(nearest->triangle);
  const Vec3 inward = -area_vector(t).normalized();
  if (surface_.is_on_boundary(nodes, nearest->L)) {
    if (boundary == AtBoundary::left_out) return std::nullopt;
    // Beside an open surface, its planes reach a little farther: nodes that are exactly below its boundary touch.
    constexpr double kBeside = 0.1;  // barycentric coordinate
    const Vec3 foot = foot_on_plane(x, t);
    const double depth = (x - t.col(0)).dot(inward);
    if (foot.minCoeff() < -kBeside || !(depth > 0 && depth <= reach_)) return std::nullopt;
    Touch touch{point, nodes, distance_of(x, t, foot, true)};
    touch.distance.n = inward;
    touch.distance.r = depth;
    return touch;
  }
  const Vec3 y = x - t * nearest->L;
  if (!(y.dot(normal) < 0)) return std::nullopt;
  const bool is_inside = nearest->L.minCoeff() > 0;  // then the normal has more digits than y
  Touch touch{point, nodes, distance_of(x, t, nearest->L)};
  if (is_inside) touch.distance.n = inward;
  return touch;
}

}  // namespace orthodyn
