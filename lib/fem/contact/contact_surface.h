// A surface that touches another one: its points with their areas, and triangles between them. Triangles of a
// quadratic face also have the nodes in the middle of edges and of quadrilaterals as corners, or its middle
// (face_middles.h). Positions and velocities are those of all points.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "lib/fem/contact/distance.h"
#include "lib/fem/contact/face_middles.h"
#include "lib/fem/nodal_vector.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

class ContactSurface {
 public:
  using Corners = std::array<int, 3>;
  struct Edge {
    std::array<int, 2> nodes;  // ascending
    double area;               // mean of its nodes, m^2
    double length;             // at rest, m
    double sharpness;          // at rest, from 0 between triangles of one plane or in a notch to 1 at 30 degrees
  };

  // The middles of faces are numbered from `first_middle` on, by default after the nodes.
  ContactSurface(const Mesh& mesh, const std::vector<FaceCorners>& faces, std::optional<int> first_middle = {});

  const std::vector<std::pair<int, double>>& areas() const { return areas_; }  // point, m^2
  const FaceMiddles& middles() const { return middles_; }
  const std::vector<Corners>& triangles() const { return triangles_; }
  const std::vector<Edge>& edges() const { return edges_; }  // of all triangles
  double mean_edge() const { return mean_edge_; }            // of the triangles at rest, m

  double thickness() const { return thickness_; }  // the least height of a cell at the surface, at rest, m

  // Whether the point with these barycentric coordinates lies on the boundary of the surface.
  bool is_on_boundary(const Corners& triangle, const Vec3& L) const;

  // The box around the nodes at the positions x.
  Eigen::AlignedBox3d box(const NodalVector& x) const;

  std::size_t bytes() const;

 private:
  FaceMiddles middles_;
  std::vector<std::pair<int, double>> areas_;
  std::vector<Corners> triangles_;
  std::vector<Edge> edges_;
  std::set<std::pair<int, int>> boundary_edges_;  // node pairs, ascending
  std::set<int> boundary_nodes_;
  double mean_edge_ = 0, thickness_ = 0;
};

// The middles of both surfaces; those of the second one are numbered after those of the first.
FaceMiddles joined(const ContactSurface& first, const ContactSurface& second);

// The force of a term on the nodes of a surface, N.
Vec3 force_on(const ContactSurface& surface, const Term& term, const NodalState& s);

// A point below a surface: its nearest place there has a depth. `distance.n` points into the body, from the surface to
// the point.
struct Touch {
  int point;
  ContactSurface::Corners triangle;
  Distance distance;

  std::array<int, 4> points() const { return {point, triangle[0], triangle[1], triangle[2]}; }
};

// The triangles of a surface at the positions x, for searches.
class PlacedSurface {
 public:
  // Both arguments must outlive this object. Finds touches up to the depth `reach` (m).
  PlacedSurface(const ContactSurface& surface, const NodalVector& x, double reach);

  // The nearest place of the surface to a point that lies below the surface; empty for other points, and for those
  // beside an open surface. Points below its boundary touch, or are left out.
  enum class AtBoundary { touches, left_out };
  std::optional<Touch> touch_of(int point, AtBoundary boundary = AtBoundary::touches) const;

 private:
  struct Placed {
    double low;  // along the axis of the search
    int triangle;
    auto operator<=>(const Placed&) const = default;
  };
  Triangle corners(int triangle) const;

  const ContactSurface& surface_;
  const NodalVector& x_;
  double reach_, widest_ = 0;
  int axis_ = 0;
  Vec3 low_, high_;
  std::vector<Placed> order_;  // ascending
};

}  // namespace orthodyn
