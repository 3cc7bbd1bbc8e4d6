// Run-time interface of an element type. Each type is an ElementTypeOf<E> (element_type_of.h) for an element E of
// lib/element and is defined in a separate file.
#pragma once

#include <memory>

#include "lib/core/cell_shape.h"
#include "lib/core/types.h"

namespace orthodyn {

class AddedLaw;
class AddedTerm;
class BlockPattern;
class ElasticTerm;
struct ElasticRegion;
struct ElementMesh;

class ElementType {
 public:
  static constexpr int kMostNodes = 27;  // largest number, so that matrices need no allocation
  // Node positions at rest (m), one column each.
  using Nodes = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMostNodes>;

  virtual ~ElementType() = default;

  virtual CellShape shape() const = 0;
  const char* name() const { return topology(shape()).name; }
  int num_nodes() const { return topology(shape()).nodes; }

  // Node positions (m) of the part of the cell that this type integrates: the whole cell or a ply.
  virtual Nodes part(const Nodes& X) const = 0;
  // Whether the cell's node with this index lies in the part.
  virtual bool holds(int node) const = 0;
  // This type for the ply begin < t < end of the third natural coordinate in [-1, 1]. Null for tetrahedra.
  virtual std::unique_ptr<const ElementType> ply(double begin, double end) const = 0;

  // Positions of the integration points at rest (m), one column each.
  virtual Eigen::Matrix3Xd points(const Nodes& X) const = 0;

  virtual int num_points() const = 0;

  // The largest d such that the shape functions span all polynomials of degree d.
  virtual int degree() const = 0;
  // Extrapolates values at the integration points to the nodes of part().
  virtual Eigen::MatrixXd points_to_nodes() const = 0;

  // Mass of the whole cell (kg) for a density in kg/m^3. Lumped masses are positive, and their sum is density times
  // volume.
  virtual Vector lumped_mass(const Nodes& X, double density) const = 0;
  virtual Eigen::MatrixXd consistent_mass(const Nodes& X, double density) const = 0;

  // Largest ratio of lumped to consistent kinetic energy of one element.
  virtual double lumped_to_consistent() const = 0;

  // Whether elastic_term() has a mixed formulation (ElasticRegion::mixed).
  virtual bool has_mixed_formulation() const = 0;

  // Makes the elastic term of a region of such elements. Type and pattern must outlive the term, the mesh need not.
  virtual std::unique_ptr<ElasticTerm> elastic_term(const ElementMesh& mesh, ElasticRegion region,
                                                    const BlockPattern& pattern) const = 0;

  // Makes the term of an added law (lib/fem/added_laws) for the elements of an elastic term that was made by this type
  // from the same mesh and pattern. Type, elastic term and pattern must outlive the term.
  virtual std::unique_ptr<AddedTerm> added_term(const ElementMesh& mesh, const ElasticTerm& elastic,
                                                std::unique_ptr<const AddedLaw> law,
                                                const BlockPattern& pattern) const = 0;
};

const ElementType& linear_tetrahedron();
const ElementType& quadratic_tetrahedron();
const ElementType& linear_hexahedron();        // 8 nodes
const ElementType& quadratic_hexahedron();     // 20 nodes, reduced integration: 8 points
const ElementType& quadratic_hexahedron_14();  // 20 nodes, full integration: 14 points
const ElementType& triquadratic_hexahedron();  // 27 nodes
const ElementType& linear_wedge();             // 6 nodes
const ElementType& quadratic_wedge();          // 15 nodes
const ElementType& biquadratic_wedge();        // 18 nodes

// The element type of a solid cell's shape.
const ElementType& element_type(CellShape shape);

}  // namespace orthodyn
