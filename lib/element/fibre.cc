#include "lib/element/fibre.h"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

constexpr double kShortest = 1e-8;  // shortest stretch whose direction is defined

Mat3T<Batch> dyad(const Vec3T<Batch>& a, const Vec3T<Batch>& b) { return a * b.transpose(); }

}  // namespace

Fibre::Fibre(const Mat3T<Batch>& H, const Mat3T<Batch>& Q, bool is_linear) : per_length(0), n(Q.col(0)) {
  const Vec3T<Batch> h = H.col(0);
  if (is_linear) {
    x = n.dot(h);
    return;
  }
  const Batch excess = Batch(2) * n.dot(h) + h.dot(h);  // lambda^2 - 1
  n += h;
  const Batch lambda = sqrt(n.dot(n));
  for (int l = 0; l < Batch::kLanes; ++l)
    if (!(lambda[l] > kShortest) || !std::isfinite(lambda[l]))
      throw RecoverableError(fmt::format("a fibre has the stretch {:.3g}", lambda[l]));
  x = excess / (lambda + Batch(1));
  per_length = Batch(1) / lambda;
  n *= per_length;
}

Mat3T<Batch> Fibre::stress(const Batch& tension) const {
  Mat3T<Batch> P = Mat3T<Batch>::Zero();
  P.col(0) = tension * n;
  return P;
}

void Fibre::add_moduli(const Batch& tension, const Batch& slope, Mat9T<Batch>& K) const {
  const Batch across = per_length * tension;
  K.topLeftCorner<3, 3>() += (slope - across) * dyad(n, n) + across * Mat3T<Batch>::Identity();
}

void Fibre::add_viscosity(const Batch& viscosity, Mat9T<Batch>& D) const {
  D.topLeftCorner<3, 3>() += viscosity * dyad(n, n);
}

void Fibre::add_turning(const Batch& viscosity, const Mat3T<Batch>& F_rate, Mat9T<Batch>& K) const {
  const Vec3T<Batch> v = F_rate.col(0), turn = per_length * (v - n.dot(v) * n);
  K.topLeftCorner<3, 3>() += Batch(0.5) * viscosity * (dyad(n, turn) + dyad(turn, n));
}

Mat3T<Batch> mean_fibre_stress(const Fibre& fibre0, const Fibre& fibre1, const Batch& mean_tension) {
  Mat3T<Batch> P = Mat3T<Batch>::Zero();
  const Batch length0 = Batch(1) + fibre0.x, length1 = Batch(1) + fibre1.x;
  const bool is_linear = fibre0.per_length[0] == 0;
  const Vec3T<Batch> sum = length0 * fibre0.n + length1 * fibre1.n;
  P.col(0) = is_linear ? Vec3T<Batch>(mean_tension * fibre0.n) : Vec3T<Batch>(mean_tension / (length0 + length1) * sum);
  return P;
}

}  // namespace orthodyn
