// A surface that touches another one: its nodes with their areas, and triangles between its nodes. Triangles of a
// quadratic face also have the nodes in the middle of edges and of quadrilaterals as corners.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "lib/fem/contact/distance.h"
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

  ContactSurface(const Mesh& mesh, const std::vector<FaceCorners>& faces);

  const std::vector<std::pair<int, double>>& areas() const { return areas_; }  // node, m^2
  const std::vector<Corners>& triangles() const { return triangles_; }
  const std::vector<Edge>& edges() const { return edges_; }  // of all triangles
  double mean_edge() const { return mean_edge_; }            // of the triangles at rest, m

  bool has_faces_of_eight_nodes() const { return has_faces_of_eight_nodes_; }

  double thickness() const { return thickness_; }  // the least height of a cell at the surface, at rest, m

  // Whether the point with these barycentric coordinates lies on the boundary of the surface.
  bool is_on_boundary(const Corners& triangle, const Vec3& L) const;

  // The box around the nodes at the positions x.
  Eigen::AlignedBox3d box(const NodalVector& x) const;

  std::size_t bytes() const;

 private:
  std::vector<std::pair<int, double>> areas_;
  std::vector<Corners> triangles_;
  std::vector<Edge> edges_;
  std::set<std::pair<int, int>> boundary_edges_;  // node pairs, ascending
  std::set<int> boundary_nodes_;
  double mean_edge_ = 0, thickness_ = 0;
  bool has_faces_of_eight_nodes_ = false;
};

// A node below a surface: its nearest point has a depth. `distance.n` points into the body, from the surface to the
// node.
struct Touch {
  int node;
  ContactSurface::Corners triangle;
  Distance distance;

  std::array<int, 4> nodes() const { return {node, triangle[0], triangle[1], triangle[2]}; }
};

// The triangles of a surface at the positions x, for searches.
class PlacedSurface {
 public:
  // Both arguments must outlive this object. Finds touches up to the depth `reach` (m).
  PlacedSurface(const ContactSurface& surface, const NodalVector& x, double reach);

  // The nearest point of the surface to a node that lies below the surface; empty for other nodes, and for nodes beside
  // an open surface. Nodes below its boundary touch, or are left out.
  enum class AtBoundary { touches, left_out };
  std::optional<Touch> touch_of(int node, AtBoundary boundary = AtBoundary::touches) const;

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
