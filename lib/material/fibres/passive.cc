// Passive stresses of fibres.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/material/fibres/curve_points.h"
#include "lib/material/fibres/fibres.h"

namespace orthodyn {
namespace {

// W = k1/(2 k2) (exp(k2 E^2) - 1) with E = lambda^2 - 1 for lambda > 1: the fibre term of Holzapfel, Gasser & Ogden, J.
// Elasticity 61 (2000). T = dW/dlambda = 2 k1 lambda E exp(k2 E^2).
class ExponentialStress : public StretchFunction {
 public:
  ExponentialStress(double k1, double k2) : k1_(k1), k2_(k2) {}

  double value(double x) const override {
    if (x <= 0) return 0;
    const double E = excess(x);
    return 2 * k1_ * (1 + x) * E * std::exp(k2_ * E * E);
  }
  double slope(double x) const override {
    if (x < 0) return 0;
    const double E = excess(x);
    return 2 * k1_ * (E + 2 * (1 + E) * (1 + 2 * k2_ * E * E)) * std::exp(k2_ * E * E);
  }
  double integral(double x) const override {
    if (x <= 0) return 0;
    const double E = excess(x);
    return k1_ / (2 * k2_) * std::expm1(k2_ * E * E);
  }
  // The quadrature is exact to round-off if the energy changes by less than a tenth; else the quotient is.
  double mean(double x0, double x1) const override {
    if (x0 <= 0 && x1 <= 0) return 0;
    const double W0 = integral(x0), W1 = integral(x1);
    return std::abs(W1 - W0) > 0.1 * std::max(W0, W1) ? (W1 - W0) / (x1 - x0) : gauss_mean(*this, x0, x1);
  }
  double slope_bound() const override { return 4 * k1_; }
  double value_bound() const override { return std::numeric_limits<double>::infinity(); }

 private:
  static double excess(double x) { return x * (2 + x); }  // E

  double k1_, k2_;
};

class ExponentialFibre : public PassiveFibre {
 public:
  static const Spec<ExponentialFibre>& spec() {
    using E = ExponentialFibre;
    static const auto s =
        Spec<E>()
            .key("k1", &E::k1_, "Stiffness: at small strains the modulus along the fibre is 4 k1.",
                 {.required = true, .unit = "Pa", .range = kPositive})
            .key("k2", &E::k2_, "Steepness of the stiffening.", {.required = true, .range = kPositive});
    return s;
  }
  std::shared_ptr<const StretchFunction> stress() const override {
    return std::make_shared<ExponentialStress>(k1_, k2_);
  }
  std::string description() const override { return fmt::format("exponential, k1 {:.4g} Pa, k2 {:.4g}", k1_, k2_); }

 private:
  double k1_ = 0, k2_ = 0;
};

// A monotone cubic for lambda > 1, zero below.
class MeasuredStress : public StretchFunction {
 public:
  explicit MeasuredStress(MonotoneCubic curve) : curve_(std::move(curve)) {}

  double value(double x) const override { return x <= 0 ? 0 : curve_.value(x); }
  double slope(double x) const override { return x < 0 ? 0 : curve_.slope(x); }
  double integral(double x) const override { return x <= 0 ? 0 : curve_.integral(0, x); }
  double mean(double x0, double x1) const override {
    if (x0 == x1) return value(x0);
    return curve_.integral(std::max(x0, 0.0), std::max(x1, 0.0)) / (x1 - x0);
  }
  double slope_bound() const override { return curve_.slope(0); }
  double value_bound() const override { return std::numeric_limits<double>::infinity(); }

 private:
  MonotoneCubic curve_;
};

class MeasuredFibre : public PassiveFibre, public CurvePoints {
 public:
  static const Spec<MeasuredFibre>& spec() {
    using M = MeasuredFibre;
    static const auto s =
        Spec<M>()
            .key(
                "points", &M::points,
                "Pairs [stretch, nominal stress in Pa]; stretches ascend from 1 or more. Between the points a monotone "
                "cubic, beyond the last one its tangent.")
            .key("file", &M::file,
                 "Instead of `points`: a CSV file with the columns stretch (or strain, from 0) and stress (Pa).")
            .check([](const M& fibre, const Config&) { fibre.stress(); });
    return s;
  }

  std::shared_ptr<const StretchFunction> stress() const override {
    std::vector<MonotoneCubic::Point> all = points_from_rest();
    for (auto& point : all) point[0] -= 1;
    return std::make_shared<MeasuredStress>(
        MonotoneCubic(all, MonotoneCubic::Ends::constant, MonotoneCubic::Ends::with_end_slopes));
  }
  std::string description() const override {
    return fmt::format("measured to the stretch {:.4g}", points_from_rest().back()[0]);
  }

 private:
  // The points with [1, 0] as the first one.
  std::vector<MonotoneCubic::Point> points_from_rest() const {
    std::vector<MonotoneCubic::Point> all = read_ascending("stretch", "stress");
    const std::string where = file ? file->path : origin.where;
    if (all.front()[0] < 1)
      throw ConfigError(where,
                        fmt::format("begins at the stretch {:.6g}; fibres bear tension only, so the curve begins "
                                    "at a stretch of 1 or more",
                                    all.front()[0]));
    if (all.front()[0] == 1 && all.front()[1] > 0)
      throw ConfigError(where, fmt::format("has the stress {:.6g} Pa at the stretch 1, but the stress begins at zero",
                                           all.front()[1]));
    if (all.front()[0] > 1) all.insert(all.begin(), {1, 0});
    return all;
  }
};

const bool exponential_registered = Registry<PassiveFibre>::add<ExponentialFibre>(
    "exponential",
    "Stiffens exponentially (Holzapfel, Gasser & Ogden 2000): the energy is k1/(2 k2) (exp(k2 (lambda^2 - 1)^2) - 1).");
const bool curve_registered = Registry<PassiveFibre>::add<MeasuredFibre>("curve", "Through measured points.");

}  // namespace
}  // namespace orthodyn
