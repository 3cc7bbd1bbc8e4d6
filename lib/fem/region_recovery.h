// Values at the nodes of a region from those at its integration points, where stresses are most accurate: around each
// corner a polynomial of the elements' degree is fitted by least squares (Zienkiewicz & Zhu 1992, Int. J. Numer. Meth.
// Eng. 33, 1331), over the elements at the corner and, where these are too few, their neighbours. A node in the middle
// of an edge takes the mean of what its two corners' polynomials are there.
#pragma once

#include <vector>

#include "lib/fem/element_mesh.h"

namespace orthodyn {

using SixColumns = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

// The polynomial that fits values at some points around a centre: x, y, z and for degree 2 their products, around the
// means of monomials and values, so that constants are met where the points are too few for more. Coordinates are those
// of the points' principal axes, each in their spread along it: patches of thin bodies are as well told apart as
// others.
struct PatchFit {
  Vec3 centre;              // m
  Mat3 to_patch;            // from places relative to the centre, 1/m
  Vector means;             // of the monomials
  Eigen::MatrixXd inverse;  // of their normal equations; a pseudo-inverse where the points do not tell them apart
};

// Of one region. Points are numbered by elements: num_points() k + p.
class RegionRecovery {
 public:
  // `cells`: its elements, by their numbers in the mesh.
  RegionRecovery(const ElementMesh& mesh, const std::vector<int>& cells, int num_points);

  // The nodes of the region, by their indices in the mesh; of each a row. `mesh` as in the constructor.
  const std::vector<int>& nodes() const { return nodes_; }
  SixColumns at_nodes(const ElementMesh& mesh, const SixColumns& at_points) const;

  // Of each element its nodes as rows of these.
  const Cells& cells() const { return cells_; }

 private:
  struct Patch {
    int row;                    // of its centre
    std::vector<int> elements;  // of the region
    PatchFit fit;
    std::vector<int> middles;  // rows of the nodes in the middle of its edges
  };

  void add_middles(const ElementType& type, const std::vector<int>& patch_of);
  Eigen::Matrix3Xd places_of(const std::vector<int>& elements) const;
  template <int kCoefficients>
  SixColumns at_nodes_with(const ElementMesh& mesh, const SixColumns& at_points) const;

  std::vector<int> nodes_;
  Cells cells_;
  Eigen::Index per_element_;    // number of points
  Eigen::Matrix3Xd places_;     // of the points, m
  std::vector<Patch> patches_;  // one for each corner
};

}  // namespace orthodyn
