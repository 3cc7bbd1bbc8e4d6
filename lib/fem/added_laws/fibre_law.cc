#include "lib/fem/added_laws/fibre_law.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

Batch finite(const Batch& value, const Fibre& fibre) {
  for (int l = 0; l < Batch::kLanes; ++l)
    if (!std::isfinite(value[l]))
      throw RecoverableError(fmt::format("the stress of a fibre of the stretch {:.4g} is not finite", 1 + fibre.x[l]));
  return value;
}

// dlambda/dt; empty for a body at rest.
std::optional<Batch> rate_of(const Fibre& fibre, const Mat3T<Batch>* F_rate) {
  return F_rate ? std::optional(fibre.rate(*F_rate)) : std::nullopt;
}

const Batch* pointer(const std::optional<Batch>& rate) { return rate ? &*rate : nullptr; }

Batch positive_part(const Batch& x) { return select(x > Batch(0), x, Batch(0)); }

}  // namespace

Mat3T<Batch> FibreLawAt::stress(const LawPoint& at, const Mat3T<Batch>* F_rate) const {
  const Fibre fibre = fibre_at(at);
  const auto rate = rate_of(fibre, F_rate);
  return fibre.stress(finite(tension(at.index, fibre.x, pointer(rate)), fibre));
}

void FibreLawAt::add_moduli(const LawPoint& at, const Mat3T<Batch>* F_rate, TangentKind kind, Mat9T<Batch>& K,
                            Mat9T<Batch>* D) const {
  const Fibre fibre = fibre_at(at);
  const auto rate = rate_of(fibre, F_rate);
  const Batch T = tension(at.index, fibre.x, pointer(rate));
  const Batch E = finite(slope(at.index, fibre.x, pointer(rate)), fibre);
  const bool is_exact = kind == TangentKind::exact;
  fibre.add_moduli(is_exact ? T : positive_part(T), is_exact ? E : positive_part(E), K);
  if (!rate) return;
  const Batch c = viscosity(at.index, fibre.x, *rate);
  if (D) fibre.add_viscosity(c, *D);
  if (is_exact) fibre.add_turning(c, *F_rate, K);
}

Mat3T<Batch> FibreLawAt::mean_stress(const LawPoint& at0, const LawPoint& at1) const {
  const Fibre fibre0 = fibre_at(at0), fibre1 = fibre_at(at1);
  return mean_fibre_stress(fibre0, fibre1, finite(mean_tension(at0.index, fibre0.x, fibre1.x), fibre1));
}

Batch FibreLawAt::energy(const LawPoint& at) const { return potential(at.index, fibre_at(at).x); }

Batch FibreLawAt::power(const LawPoint& at, const Mat3T<Batch>&) const { return supply(at.index, fibre_at(at).x); }

Batch FibreLawAt::dissipation(const LawPoint& at, const Mat3T<Batch>& F_rate) const {
  const Fibre fibre = fibre_at(at);
  const Batch rate = fibre.rate(F_rate);
  return (tension(at.index, fibre.x, &rate) - tension(at.index, fibre.x, nullptr)) * rate;
}

Mat3T<Batch> FibreLawAt::turned_stress(const LawPoint& at) const {
  Mat3T<Batch> stress = Mat3T<Batch>::Zero();
  stress(0, 0) = tension(at.index, fibre_at(at).x, nullptr);
  return stress;
}

}  // namespace orthodyn
