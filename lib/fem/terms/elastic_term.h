// Elasticity of the elements of one region, with optional stiffness-proportional damping:
//
//     f_a = - sum over points p of V_p P(F_p, dF_p/dt) grad N_a(p),
//
// with the volume V_p of point p, the shape functions N_a, and the first Piola-Kirchhoff stress P (Pa) of the region's
// law (lib/element). Made by ElementType::elastic_term(). Elements are numbered k in [0, size()). Thread-safe for
// different output arguments. Except with linear kinematics, forces, tangents, energies and observations throw
// RecoverableError if a deformation gradient is not finite.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/element/observation.h"
#include "lib/fem/element_axes.h"
#include "lib/fem/term.h"
#include "lib/fem/terms/elasticity_options.h"
#include "lib/material/stiffness.h"
#include "lib/material/strength.h"

namespace orthodyn {

// A region of a mesh with its elastic constants and axes, or the part of a ply in one level of cells
// (lib/mesh/stack.h); the input of ElementType::elastic_term().
struct ElasticRegion {
  std::string name;
  std::vector<int> cells;  // indices in the mesh; may be empty on a rank
  Stiffness stiffness;     // Pa, in material axes
  ElementAxes axes;        // of `cells`, in their order
  double beta = 0;         // s, stiffness-proportional damping; 0 for none
  ElasticityOptions options;
  std::optional<Strength> strength = {};  // empty if the material has no strengths
  std::vector<int> numbers = {};          // indices of `cells` in the whole mesh; empty with one rank
  int elements = 0;                       // number of the region's elements on all ranks
  std::string mesh_region = {};  // name of the region in the mesh; `name` except for a ply or one of several kinds
  std::string ply = {};          // name of the whole ply, of which this may be a part; "" for a region
  std::vector<int> cells_of_all = {};  // cells of all ranks in the whole mesh, ascending; empty with one rank
  double share = 1;                    // of a ply in the thickness of its cells
  int stiffness_cell = -1;      // cell of the region's grid of stiffness factors; -1 for a region without factors
  double stiffness_factor = 1;  // by which `stiffness` was multiplied
  bool mixed = false;           // formulation for nearly incompressible materials (mixed_elastic_term.h)
  // Of a viscoelastic material after all relaxation, Pa; empty for other materials.
  std::optional<Stiffness> relaxed = {};
  // Why a nearly incompressible region has not the mixed formulation, such as "with law: neo_hookean"; "" if it could.
  std::string mixed_obstacle = {};
  // The stiffness that decides whether the material is nearly incompressible.
  const Stiffness& softest() const { return relaxed ? *relaxed : stiffness; }
};

class AddedTerm;

class ElasticTerm : public Term {
 public:
  EnergyKind energy_kind() const override { return EnergyKind::elastic; }

  // The region that the term was made for: elements, constants, axes and options.
  virtual const ElasticRegion& definition() const = 0;
  const std::string& region() const { return definition().name; }
  Mat6 stiffness() const {
    return voigt(definition().stiffness);
  }  // Pa, in material axes; component order of stiffness.h

  // Whether another law has taken the place of the corotational one, whose limits then do not hold.
  virtual bool is_replaced() const { return false; }

  // Description of the law, such as "corotational, exact gradient".
  virtual std::string law() const = 0;

  // False for the warped force, which has no discrete gradient either.
  virtual bool has_energy() const = 0;

  // Number of elements on this rank, and index of element k in the whole mesh.
  virtual int size() const = 0;
  virtual int cell(int k) const = 0;

  // Strain, stress and axes of element k, for its mean deformation gradient.
  virtual PointObservation observe(int k, const NodalState& s) const = 0;

  // The terms of added laws (lib/fem/added_laws) in this region. They are terms of their own in the model.
  virtual std::vector<const AddedTerm*> added() const { return {}; }

  // Type of the region's elements.
  virtual const ElementType& type() const = 0;

  // Number of integration points per element, and strain, stress and axes at one of them.
  virtual int num_points() const = 0;
  virtual PointObservation observe_point(int k, int point, const NodalState& s) const = 0;

  // observe_point() at all points of element k.
  virtual std::vector<PointObservation> observe_element(int k, const NodalState& s) const = 0;

  // Calls visit(k, point, observation) for all points, concurrently for different elements. Much faster than
  // observe_point().
  using VisitPoint = std::function<void(int k, int point, const PointObservation& observation)>;
  virtual void observe_points(const NodalState& s, const VisitPoint& visit) const = 0;

  // PointObservation::strain at all points in Voigt form with engineering shear, one column per point, element by
  // element. Much faster than observe_point().
  virtual Eigen::Matrix<double, 6, Eigen::Dynamic> strains(const NodalState& s) const = 0;

  // The stress in material axes that turn with the material, Pa: C : e for these strains e. In the mixed formulation
  // C' : e plus the volumetric stress (mixed_elastic_term.h). Columns as in strains().
  virtual Eigen::Matrix<double, 6, Eigen::Dynamic> stresses(const NodalState& s) const = 0;

  // Largest norm of Green's strain (F^T F - I)/2 over all points. Much faster than strains().
  virtual double largest_green_strain(const NodalState& s) const = 0;

  // At a point of the undeformed element: material axes (columns), and sym(grad u) in these axes for a small
  // displacement u (m).
  virtual Mat3 axes_at_rest(int k, int point) const = 0;
  virtual Mat3 small_strain(int k, int point, const NodalVector& u) const = 0;

  // Smallest det F over the points of element k; not positive if the element is inverted.
  virtual double det_F(int k, const NodalState& s) const = 0;

  // Smallest det_F() of all elements, to round-off, and the number of its element; infinity and -1 if all values are
  // NaN. Much faster than det_F() for each element.
  struct SmallestDetF {
    double value;
    int element;
  };
  virtual SmallestDetF smallest_det_F(const NodalState& s) const = 0;

  // Upper bound of the squared angular frequency of an element about rest with lumped masses, 1/s^2; density in kg/m^3.
  // The critical time step of central differences is at least 2 / sqrt(result).
  virtual double max_frequency_squared(double density) const = 0;
};

}  // namespace orthodyn
