// Values at the nodes of a region from those at its integration points, where stresses are most accurate: around each
// corner a polynomial of the elements' degree is fitted by least squares (Zienkiewicz & Zhu 1992, Int. J. Numer. Meth.
// Eng. 33, 1331), over the elements at the corner and, where these are too few, their neighbours. A node in the middle
// of an edge takes the mean of what its two corners' polynomials are there. And the error of the elastic energy that
// the difference of recovered and computed stresses tells.
//
// Regions are recovered one by one, for stresses jump between them. Thread-safe: computed once, at the first use.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "lib/fem/element_mesh.h"
#include "lib/fem/terms/elastic_term.h"

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
  Eigen::Index per_element_;  // number of points
  Eigen::Matrix3Xd places_;   // of the points, m
  std::vector<Patch> patches_;  // one for each corner
};

// Of the elements of a region, in their order.
struct RegionMeshError {
  Vector volume;  // m^3
  Vector error;   // J, elastic energy of the error that the mesh makes
  double energy;  // J, of the computed stresses in all of them
};

// Recovered less computed stress in the axes of space at rest, Pa: of each term's region a row for each node of each of
// its elements, on all ranks. Of a derivative along a displacement, Pa/m.
using StressMisfit = std::vector<SixColumns>;

class StressRecovery {
 public:
  using Terms = std::vector<std::unique_ptr<ElasticTerm>>;

  // All must outlive it. Where several ranks have parts of the terms, `mesh` is the whole one, and what is computed at
  // their points comes from all: functions are collective, states are of the subdomain.
  StressRecovery(const TetMesh& mesh, const Terms& terms, const Subdomain* subdomain)
      : mesh_(mesh), terms_(terms), subdomain_(subdomain) {}

  std::size_t num_nodes() const { return mesh_.nodes.size(); }

  // Of what is seen at the points, six components: a column per node of the mesh; at nodes of several regions their
  // mean.
  using Seen = std::function<Vec6(const PointObservation&)>;
  Eigen::Matrix<double, 6, Eigen::Dynamic> at_nodes(const NodalState& s, const Seen& seen) const;

  // The same of one term's region by itself: its nodes, and a row for each. Valid as long as this.
  struct OfRegion {
    const std::vector<int>* nodes;
    SixColumns values;
  };
  OfRegion at_nodes_of_region(std::size_t region, const NodalState& s, const Seen& seen) const;

  // One for each term, of its elements on this rank.
  std::vector<RegionMeshError> mesh_errors(const NodalState& s) const;

  // Of the stress in a state, and of its derivative along a displacement from there.
  StressMisfit misfit(const NodalState& s) const;
  StressMisfit misfit_along(const NodalVector& direction, const NodalState& s) const;
  // The integral of a : C^-1 : b over the body: what the energy of a and b together is above that of each, J.
  double product(const StressMisfit& a, const StressMisfit& b) const;

 private:
  // The elements of a region on all ranks.
  struct Region {
    RegionRecovery recovery;
    std::vector<int> places;  // among these of the term's elements
  };

  StressMisfit misfit_of(const std::vector<SixColumns>& at_points) const;
  const std::vector<Region>& regions() const;
  Region make_region(const ElementMesh& mesh, const ElasticTerm& term) const;
  SixColumns of_all_ranks(std::size_t region, SixColumns at_points) const;

  const TetMesh& mesh_;
  const Terms& terms_;
  const Subdomain* subdomain_;
  mutable std::once_flag once_;
  mutable std::vector<Region> regions_;
};

}  // namespace orthodyn
