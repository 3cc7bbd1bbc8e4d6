// A stress at the integration points of a region that adds to the stress of its elastic law: of swelling, of fibres, of
// contraction. Each such law has its own file.
//
// As in the elastic laws (corotational_law.h), the input is H Q with the displacement gradient H and the material axes
// Q, and the output the first Piola-Kirchhoff stress times the axes, P Q, for a batch of elements. A point is named by
// its index: number of integration points times batch plus point.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/element/batch.h"
#include "lib/element/tangent_form.h"
#include "lib/ode/internal_variables.h"
#include "lib/ode/model.h"
#include "lib/ode/step_limits.h"

namespace orthodyn {

struct LawPoint {
  std::size_t index;
  const Mat3T<Batch>& H;  // H Q
  const Mat3T<Batch>& Q;  // the material axes as columns
};

// The law at one time. Thread-safe.
class AddedLawAt {
 public:
  virtual ~AddedLawAt() = default;

  // P Q, Pa. `rate`: dF/dt Q (1/s), null for a body at rest; laws that do not depend on it ignore it.
  virtual Mat3T<Batch> stress(const LawPoint& at, const Mat3T<Batch>* rate) const = 0;

  // Adds d(P Q)/d(H Q) to K and, unless D is null, d(P Q)/d(dF/dt Q) to D (Pa, Pa s). The matrices act on the columns
  // of H Q, one after the other. With TangentKind::gauss_newton, K is positive semidefinite.
  virtual void add_moduli(const LawPoint& at, const Mat3T<Batch>* rate, TangentKind kind, Mat9T<Batch>& K,
                          Mat9T<Batch>* D) const = 0;

  // The mean stress between the states H0 and H1 of one point (DiscreteGradient in lib/ode/model.h), with
  // P : (F1 - F0) equal to the change of the energy and P (F0 + F1)^T symmetric. Not called for laws without an energy.
  virtual Mat3T<Batch> mean_stress(const LawPoint& at0, const LawPoint& at1) const = 0;

  virtual Batch energy(const LawPoint& at) const = 0;  // J/m^3
  // The power that the law supplies to the body: the rate of its energy at a fixed shape, and the work of forces
  // without an energy. W/m^3
  virtual Batch power(const LawPoint& at, const Mat3T<Batch>& rate) const = 0;
  virtual Batch dissipation(const LawPoint& /*at*/, const Mat3T<Batch>& /*rate*/) const { return Batch(0); }  // W/m^3

  // The stress in the material axes, which turn with the material, Pa.
  virtual Mat3T<Batch> turned_stress(const LawPoint& at) const = 0;
};

// The internal variables of the points of a law (lib/ode/internal_variables.h), all points of an element after each
// other: six strains for each relaxation time.
struct PointInternals {
  InternalState state;
  Eigen::Index first = 0;  // of the law's variables among those of the model
  int elements = 0;
  int points = 1;  // of an element
};

// A law with internal variables, at one time.
class InternalLawAt : public AddedLawAt {
 public:
  // The strain to which all variables of a point tend, the same without stress-free strains, and their derivative for a
  // change dH Q of H Q.
  virtual Vec6T<Batch> strain(const LawPoint& at) const = 0;
  virtual Vec6T<Batch> total_strain(const LawPoint& at) const = 0;
  virtual Vec6T<Batch> strain_change(const LawPoint& at, const Mat3T<Batch>& dH) const = 0;
};

class InternalLaw {
 public:
  virtual ~InternalLaw() = default;
  virtual std::vector<double> relaxation_times() const = 0;  // s
  virtual std::shared_ptr<const InternalLawAt> at(double t, const PointInternals& internals) const = 0;
};

class AddedLaw {
 public:
  virtual ~AddedLaw() = default;
  virtual std::string name() const = 0;         // such as "expansion by moisture"
  virtual std::string description() const = 0;  // the name with its constants
  virtual std::size_t bytes() const = 0;
  // `load_factor`: by which the law is multiplied; only for laws that are loads.
  virtual std::shared_ptr<const AddedLawAt> at(double t, double load_factor = 1) const = 0;
  // This law with corotational kinematics.
  virtual std::unique_ptr<AddedLaw> corotational() const = 0;

  // As Term::is_load(), add_peak_force() and seconds_at_peak().
  virtual bool is_load() const = 0;
  virtual std::shared_ptr<const AddedLawAt> at_peak(double start, double end) const = 0;
  virtual double seconds_at_peak(double start, double end) const = 0;

  // Whether the stress is proportional to the elastic stiffness.
  virtual bool scales_with_stiffness() const { return false; }

  virtual bool has_energy() const = 0;
  virtual bool depends_on_rate() const { return false; }
  virtual bool dissipates() const { return depends_on_rate(); }
  // This law's internal variables; null if it has none. at() is then not called.
  virtual const InternalLaw* internal() const { return nullptr; }
  virtual bool depends_on_time() const = 0;
  // Whether the force does not depend on the displacements.
  virtual bool is_dead() const = 0;
  // Upper bound of the moduli d(P Q)/d(H Q) that the law adds to those of elasticity, Pa.
  virtual double largest_modulus() const { return 0; }

  virtual std::vector<double> breakpoints(double /*start*/, double /*end*/) const { return {}; }
  virtual StepLimits step_limits(double /*start*/, double /*end*/) const { return {}; }
};

}  // namespace orthodyn
