// What the finite element model asks of a kind of element that it does not know when it is compiled. Each kind is
// ElementTypeOf<E> (element_type_of.h) for an element E of lib/element, in a file of its own.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "lib/core/types.h"

namespace orthodyn {

class BlockPattern;
class ElasticTerm;
struct ElasticRegion;
struct ElementMesh;

class ElementType {
 public:
  static constexpr int kMostNodes = 10;  // and points: matrices of one element need no allocation
  // Positions at rest, a column per node, m.
  using Nodes = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMostNodes>;

  virtual ~ElementType() = default;

  virtual const char* name() const = 0;
  virtual int num_nodes() const = 0;
  virtual int vtk_cell_type() const = 0;

  // Where the law is evaluated: a column per integration point, m, at rest.
  virtual Nodes points(const Nodes& X) const = 0;

  // The first nodes of a cell are its corners; the others lie between two of these each, in this order.
  virtual int num_corners() const = 0;
  virtual std::span<const std::array<int, 2>> edges_with_middles() const = 0;

  // Element::kDegree and points_to_nodes().
  virtual int degree() const = 0;
  virtual Eigen::MatrixXd points_to_nodes() const = 0;

  // Of one element, kg; density in kg/m^3. The lumped masses are positive and sum to density times volume.
  virtual Vector lumped_mass(const Nodes& X, double density) const = 0;
  virtual Eigen::MatrixXd consistent_mass(const Nodes& X, double density) const = 0;

  // The largest ratio of lumped to consistent kinetic energy of one element.
  virtual double lumped_to_consistent() const = 0;

  // Elasticity of some cells of a mesh of this type. The pattern must outlive the term, the mesh need not.
  virtual std::unique_ptr<ElasticTerm> elastic_term(const ElementMesh& mesh, ElasticRegion region,
                                                    const BlockPattern& pattern) const = 0;
};

// The types there are.
const ElementType& linear_tetrahedron();
const ElementType& quadratic_tetrahedron();

}  // namespace orthodyn
