// Elasticity of the elements of one region, with optional stiffness-proportional damping:
//
//     f_a = - sum over points p of V_p P(F_p, dF_p/dt) grad N_a(p),
//
// with the first Piola-Kirchhoff stress P (Pa) of the region's law (lib/element). Made by ElementType::elastic_term.
// Elements are numbered k in [0, size()). Functions are const, hold no state and may run at the same time on different
// outputs. All throw RecoverableError where a deformation gradient is not finite.
#pragma once

#include <string>

#include "lib/element/observation.h"
#include "lib/fem/elastic_region.h"
#include "lib/fem/term.h"

namespace orthodyn {

class ElasticTerm : public Term {
 public:
  EnergyKind energy_kind() const override { return EnergyKind::elastic; }

  // What it was made from.
  virtual const ElasticRegion& definition() const = 0;
  const std::string& region() const { return definition().name; }

  // The law in words, e.g. "corotational, exact gradient".
  virtual std::string law() const = 0;

  // False for the warped force: then there is no discrete gradient.
  virtual bool has_energy() const = 0;

  // The number of elements, and the index of element k in the mesh.
  virtual int size() const = 0;
  virtual int cell(int k) const = 0;

  // What can be seen at the mean deformation gradient of an element.
  virtual PointObservation observe(int k, const NodalState& s) const = 0;

  // At one of the points where the law is evaluated.
  virtual int num_points() const = 0;
  virtual PointObservation observe_point(int k, int point, const NodalState& s) const = 0;

  // The strains that are observed at all points, in Voigt form with engineering shear: a column each, those of an
  // element beside each other. Far cheaper than one by one.
  virtual Eigen::Matrix<double, 6, Eigen::Dynamic> strains(const NodalState& s) const = 0;

  // The largest norm of Green's strain (F^T F - I)/2 at all points: far cheaper than what is observed.
  virtual double largest_green_strain(const NodalState& s) const = 0;

  // The same point at rest: material axes (columns), and in them sym(grad u) of a small displacement u (m).
  virtual Mat3 axes_at_rest(int k, int point) const = 0;
  virtual Mat3 small_strain(int k, int point, const NodalVector& u) const = 0;

  // Pa, in material axes, in the order of stiffness.h.
  virtual Mat6 stiffness() const = 0;

  // The smallest of the element's points; not positive where it is inverted.
  virtual double det_F(int k, const NodalState& s) const = 0;

  // The element where that is smallest, to round-off: far cheaper than to ask for each. Infinite, of element -1, where
  // none is a number.
  struct SmallestDetF {
    double value;
    int element;
  };
  virtual SmallestDetF smallest_det_F(const NodalState& s) const = 0;

  // Upper bound of the squared angular frequency of any element about rest with lumped masses, 1/s^2;
  // density in kg/m^3. Critical steps of explicit schemes are 2 / omega.
  virtual double max_frequency_squared(double density) const = 0;
};

}  // namespace orthodyn
