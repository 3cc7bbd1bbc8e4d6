// The stress of a tension along the fibres (lib/element/fibre.h); base of the passive and the active fibres.
#pragma once

#include "lib/element/fibre.h"
#include "lib/element/lanes.h"
#include "lib/fem/added_laws/added_law.h"

namespace orthodyn {

// Its functions throw RecoverableError if the stretch of a fibre is zero, or the stretch or the tension not finite.
class FibreLawAt : public AddedLawAt {
 public:
  Mat3T<Batch> stress(const LawPoint& at, const Mat3T<Batch>* rate) const override;
  void add_moduli(const LawPoint& at, const Mat3T<Batch>* rate, TangentKind kind, Mat9T<Batch>& K,
                  Mat9T<Batch>* D) const override;
  Mat3T<Batch> mean_stress(const LawPoint& at0, const LawPoint& at1) const override;
  Batch energy(const LawPoint& at) const override;
  Batch power(const LawPoint& at, const Mat3T<Batch>& rate) const override;
  Batch dissipation(const LawPoint& at, const Mat3T<Batch>& rate) const override;

  // The tension along axis 1.
  Mat3T<Batch> turned_stress(const LawPoint& at) const override;

 protected:
  explicit FibreLawAt(bool is_linear) : is_linear_(is_linear) {}

  // At point `index`, for the strain x = lambda - 1 along the fibre and, unless it is null, its rate (1/s).
  virtual Batch tension(std::size_t index, const Batch& x, const Batch* rate) const = 0;  // Pa
  virtual Batch slope(std::size_t index, const Batch& x, const Batch* rate) const = 0;    // dT/dx, Pa
  virtual Batch viscosity(std::size_t, const Batch& /*x*/, const Batch& /*rate*/) const { return Batch(0); }  // Pa s
  // Of the tension without a rate: its mean from x0 to x1, its potential (J/m^3) and the rate of the potential at a
  // fixed x (W/m^3).
  virtual Batch mean_tension(std::size_t index, const Batch& x0, const Batch& x1) const = 0;
  virtual Batch potential(std::size_t index, const Batch& x) const = 0;
  virtual Batch supply(std::size_t, const Batch& /*x*/) const { return Batch(0); }

 private:
  Fibre fibre_at(const LawPoint& at) const { return {at.H, at.Q, is_linear_}; }

  bool is_linear_;
};

}  // namespace orthodyn
