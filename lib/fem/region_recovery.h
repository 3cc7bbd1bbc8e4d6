// Recovers nodal values of a region from its integration points, where stresses are most accurate. Around each corner,
// a polynomial of the element degree is fitted by least squares (Zienkiewicz & Zhu 1992, Int. J. Numer. Meth. Eng. 33,
// 1331) to the points of the elements at the corner and, if these are too few, of their neighbours. The middle of an
// edge, face or cell takes the mean of the polynomials of its corners.
#pragma once

#include <functional>
#include <vector>

#include "lib/fem/element_mesh.h"

namespace orthodyn {

using SixColumns = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

// Least-squares polynomial around a centre. Monomials (x, y, z, for degree 2 also their products) and values are taken
// relative to their means, so that constants are exact even with too few points. Coordinates are along the principal
// axes of the points and scaled by their spread, so that patches of thin bodies are well conditioned.
struct PatchFit {
  // Origin of the polynomial, m: the corner; or the mean of the points if they do not determine all coefficients, and
  // for hexahedra of 20 nodes with 8 points.
  Vec3 centre;
  Mat3 to_patch;            // maps a place relative to the centre to patch coordinates, 1/m
  Vector means;             // of the monomials
  Eigen::MatrixXd inverse;  // (pseudo-)inverse of the normal equations
};

// Recovery for one region. Point p of element k has the index num_points * k + p.
class RegionRecovery {
 public:
  // `cells`: the region's elements, by their indices in the mesh, all of the given type.
  RegionRecovery(const ElementMesh& mesh, const std::vector<int>& cells, const ElementType& type);

  // The region's nodes (indices in the mesh), and the values recovered at these nodes, one row per node. For a ply,
  // which fills only a part of each cell, the values are at the node positions of ElementType::part(). `at_points`: one
  // row per point.
  const std::vector<int>& nodes() const { return nodes_; }
  SixColumns at_nodes(const SixColumns& at_points) const;

  // The values recovered at one node; `row` is its index in nodes(). `at_point` returns the values of element k at its
  // point p. It is called only for the points of the patches around the node.
  using AtPoint = std::function<Vec6(int k, int p)>;
  Vec6 at_node(int row, const AtPoint& at_point) const;

  // Whether each node lies in the part of its cells over which the elements integrate; parallel to nodes().
  const std::vector<char>& inside() const { return inside_; }

  // Nodes of each element, as indices into nodes().
  const Cells& cells() const { return cells_; }

 private:
  // A node in the middle of an edge, face or cell, and the weight of a corner's polynomial there.
  struct Middle {
    int row;
    double share;
  };
  struct Patch {
    int row;                    // of the centre in nodes()
    std::vector<int> elements;  // numbers of elements in the region
    PatchFit fit;
    std::vector<Middle> middles;  // around the corner
  };

  void add_middles(const std::vector<int>& patch_of);
  Eigen::Matrix3Xd places_of(const std::vector<int>& elements) const;
  template <int kCoefficients>
  class PatchSolver;
  template <int kCoefficients>
  SixColumns at_nodes_with(const SixColumns& at_points) const;
  template <int kCoefficients>
  Vec6 at_node_with(int row, const AtPoint& at_point) const;

  std::vector<int> nodes_;
  std::vector<char> inside_;
  Eigen::Matrix3Xd node_places_;  // m, parallel to nodes_
  Cells cells_;
  Eigen::Index per_element_;    // points per element
  int degree_ = 1;              // of the polynomials
  Eigen::Matrix3Xd places_;     // positions of the points, m
  std::vector<Patch> patches_;  // one per corner
};

}  // namespace orthodyn
