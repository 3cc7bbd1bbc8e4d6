// Force-length factors of active fibres.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/material/fibres/curve_points.h"
#include "lib/material/fibres/fibres.h"

namespace orthodyn {
namespace {

// exp(-u^2) with u = (lambda - centre) / deviation.
class Bell : public StretchFunction {
 public:
  Bell(double centre, double deviation) : centre_(centre), deviation_(deviation) {}

  double value(double x) const override { return std::exp(-u(x) * u(x)); }
  double slope(double x) const override { return -2 * u(x) / deviation_ * value(x); }
  double integral(double x) const override {
    return deviation_ * 0.5 * std::sqrt(std::numbers::pi) * (std::erf(u(x)) - std::erf(u(-1)));
  }
  double mean(double x0, double x1) const override {
    constexpr double kShort = 0.1;  // relative to the deviation: quadrature is exact to round-off
    return std::abs(x1 - x0) < kShort * deviation_ ? gauss_mean(*this, x0, x1)
                                                   : (integral(x1) - integral(x0)) / (x1 - x0);
  }
  double slope_bound() const override { return std::sqrt(2 / std::numbers::e) / deviation_; }
  double value_bound() const override { return 1; }

 private:
  double u(double x) const { return (x + (1 - centre_)) / deviation_; }

  double centre_, deviation_;
};

class GaussianLength : public ForceLength {
 public:
  static const Spec<GaussianLength>& spec() {
    using G = GaussianLength;
    static const auto s =
        Spec<G>()
            .key("optimal_stretch", &G::optimal_, "Stretch of the largest force.", {.range = kPositive})
            .key("width", &G::width_,
                 "The factor is 1/e at the optimal stretch times 1 - width and 1 + width. The default approximates "
                 "sarcomeres (Thelen 2003).",
                 {.range = kPositive});
    return s;
  }
  std::shared_ptr<const StretchFunction> factor() const override {
    return std::make_shared<Bell>(optimal_, width_ * optimal_);
  }

 private:
  double optimal_ = 1, width_ = 0.67;
};

class MeasuredFactor : public StretchFunction {
 public:
  explicit MeasuredFactor(const std::vector<MonotoneCubic::Point>& points)
      : curve_(points, MonotoneCubic::Ends::constant, MonotoneCubic::Ends::constant) {
    for (const auto& point : points) largest_ = std::max(largest_, point[1]);
  }

  double value(double x) const override { return curve_.value(x); }
  double slope(double x) const override { return curve_.slope(x); }
  double integral(double x) const override { return curve_.integral(-1, x); }
  double mean(double x0, double x1) const override {
    return x0 == x1 ? value(x0) : curve_.integral(x0, x1) / (x1 - x0);
  }
  double slope_bound() const override { return curve_.largest_slope(); }
  double value_bound() const override { return largest_; }

 private:
  MonotoneCubic curve_;
  double largest_ = 0;
};

class MeasuredLength : public ForceLength, public CurvePoints {
 public:
  static const Spec<MeasuredLength>& spec() {
    using M = MeasuredLength;
    static const auto s =
        Spec<M>()
            .key("points", &M::points,
                 "Pairs [stretch, factor]; stretches ascend. Between the points a monotone cubic, outside constant.")
            .key("file", &M::file,
                 "Instead of `points`: a CSV file with the columns stretch (or strain, from 0) and factor.")
            .check([](const M& length, const Config&) { length.factor(); });
    return s;
  }
  std::shared_ptr<const StretchFunction> factor() const override {
    std::vector<MonotoneCubic::Point> all = read("stretch", "factor");
    for (auto& point : all) point[0] -= 1;
    return std::make_shared<MeasuredFactor>(all);
  }
};

const bool gaussian_registered = Registry<ForceLength>::add<GaussianLength>(
    "gaussian", "exp(-((lambda/optimal_stretch - 1)/width)^2), after Thelen, J. Biomech. Eng. 125 (2003).");
const bool length_table_registered = Registry<ForceLength>::add<MeasuredLength>("table", "Through given points.");

}  // namespace
}  // namespace orthodyn
