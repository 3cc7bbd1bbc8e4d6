// Elasticity of the tetrahedra of one region, with optional stiffness-proportional damping.
#pragma once

#include <memory>

#include "lib/element/corotational_law.h"
#include "lib/element/observation.h"
#include "lib/fem/block_pattern.h"
#include "lib/fem/element_axes.h"
#include "lib/fem/term.h"
#include "lib/fem/terms/elasticity_options.h"

namespace orthodyn {

class ElasticTerm : public Term {
 public:
  EnergyKind energy_kind() const override { return EnergyKind::elastic; }

  // The region of the mesh that its elements are.
  virtual const std::string& region() const = 0;

  // The law in words, e.g. "corotational, exact".
  virtual std::string law() const = 0;

  // The element's index in the mesh, for k in [0, size()).
  virtual int size() const = 0;
  virtual int cell(int k) const = 0;
  virtual PointObservation observe(int k, const NodalState& s) const = 0;
  // sym(grad u) in material axes, of a small displacement u (m).
  virtual Mat3 small_strain(int k, const NodalVector& u) const = 0;
  // False for the warped force: then there is no discrete gradient.
  virtual bool has_energy() const = 0;
  virtual double det_F(int k, const NodalState& s) const = 0;

  // Upper bound of the squared angular frequency of any element about rest, for lumped masses
  // density V / 4 at its nodes, 1/s^2; critical steps of explicit schemes are 2 / omega.
  virtual double max_frequency_squared(double density) const = 0;
};

// `cells` are indices into mesh.tets, `axes` those of these elements; beta in seconds, 0 for none. The
// pattern must outlive the term.
std::unique_ptr<ElasticTerm> make_elastic_term(const std::string& region, const TetMesh& mesh,
                                               std::vector<int> cells, const Stiffness& stiffness,
                                               const ElementAxes& axes, double beta,
                                               const ElasticityOptions& options,
                                               const BlockPattern& pattern);

}  // namespace orthodyn
