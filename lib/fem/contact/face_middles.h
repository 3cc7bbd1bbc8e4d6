// Contact acts at points: the nodes of a surface, and the middles of its faces of six and of eight nodes, which are
// numbered after the nodes of the mesh.
//
// The middle moves with the shape functions of the face: x = sum_k w_k x_k, with w = -1/9 at the corners of a triangle
// and 4/9 at the nodes on its edges, and -1/4 and 1/2 of a quadrilateral. The areas of corners, nodes on edges and
// middle are those of quadrature rules of degree 3: 1/20, 2/15 and 9/20 of a triangle, 1/36, 1/9 and 4/9 of a
// quadrilateral (Simpson). Equal pressures at all points then give the consistent forces of a uniform pressure: 0 at
// corners and 1/3 on edges of a triangle, -1/12 and 1/3 of a quadrilateral. Pushing forces on the nodes alone cannot.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "lib/fem/term.h"
#include "lib/mesh/mesh.h"

namespace orthodyn {

class FaceMiddles {
 public:
  static bool has_middle(int nodes_of_face) { return nodes_of_face == 6 || nodes_of_face == 8; }

  // An empty list of middles. add() gives them the numbers `first`, `first` + 1, ...; nodes have smaller numbers.
  explicit FaceMiddles(int first) : first_(first) {}

  bool empty() const { return faces_.empty(); }
  bool has(int point) const { return point >= first_; }
  int first() const { return first_; }
  int end() const { return first_ + static_cast<int>(faces_.size()); }  // the number of the next middle

  // Adds a face of six or eight nodes, corners first. Returns the number of its middle.
  int add(std::span<const int> nodes);
  // Adds the middles of another surface, which are numbered from end() on.
  void append(const FaceMiddles& other);

  // visit(node, weight) of a point.
  template <class Visit>
  void for_each_node(int point, Visit&& visit) const {
    if (!has(point)) return void(visit(point, 1.0));
    const NodesOfFace& face = faces_[static_cast<std::size_t>(point - first_)];
    for (int k = 0; k < face.size; ++k) visit(face.nodes[static_cast<std::size_t>(k)], face.weight(k));
  }
  // The nodes of the face around a middle.
  std::span<const int> face(int middle) const {
    const NodesOfFace& face = faces_[static_cast<std::size_t>(middle - first_)];
    return {face.nodes.data(), static_cast<std::size_t>(face.size)};
  }
  // The sum of |w_k| of a point.
  double sum_of_weights(int point) const;

  // Values at all points, from those at nodes. Returns `nodal` itself if there are no middles, else `storage`.
  const NodalVector& values(const NodalVector& nodal, NodalVector& storage) const;

 private:
  struct NodesOfFace {
    std::array<int, 8> nodes;
    int size;
    double weight(int k) const { return size == 6 ? (k < 3 ? -1.0 / 9 : 4.0 / 9) : (k < 4 ? -0.25 : 0.5); }
  };
  int first_;
  std::vector<NodesOfFace> faces_;
};

// The positions x (m) and velocities v (m/s) of the points of a contact. `moves`: whether the velocities are computed;
// v is empty if not. The state and the middles must outlive this object.
class PointState {
 public:
  PointState(const FaceMiddles& middles, const NodalState& s, bool moves)
      : x(middles.values(s.x, x_)), v(moves ? middles.values(s.v, v_) : v_) {}
  PointState(const PointState&) = delete;
  PointState& operator=(const PointState&) = delete;

 private:
  NodalVector x_, v_;

 public:
  const NodalVector &x, &v;
};

// The points of faces and their areas (m^2), ascending; adds the middles of faces, in the order of the faces.
std::vector<std::pair<int, double>> contact_areas(const Mesh& mesh, const std::vector<FaceCorners>& faces,
                                                  FaceMiddles& middles);

// The points of one rank, and their areas: its own nodes, and the middles of its faces, which are added to `here`.
std::vector<std::pair<int, double>> contact_areas_of(const Subdomain& subdomain,
                                                     const std::vector<std::pair<int, double>>& areas,
                                                     const FaceMiddles& middles, FaceMiddles& here);

}  // namespace orthodyn
