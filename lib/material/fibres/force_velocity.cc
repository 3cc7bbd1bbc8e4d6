// Force-velocity factors of active fibres.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/material/fibres/curve_points.h"
#include "lib/material/fibres/fibres.h"

namespace orthodyn {
namespace {

// Hill's hyperbola for shortening: (f + a)(v + b) = (1 + a) b with f = 0 at the largest velocity. With s the rate over
// the largest rate and the curvature a,
//     f = (1 + s) / (1 - s/a) for -1 <= s <= 0,    f = 1 + (e - 1) s / (s + c) for s > 0,
// where c makes the slope continuous at s = 0, and e is the limit for fast lengthening.
class HillFactor : public RateFunction {
 public:
  HillFactor(double fastest, double curvature, double limit)
      : fastest_(fastest), a_(curvature), excess_(limit - 1), c_(excess_ * a_ / (1 + a_)) {}

  double value(double rate) const override {
    const double s = rate / fastest_;
    if (s <= -1) return 0;
    return s <= 0 ? (1 + s) / (1 - s / a_) : 1 + excess_ * s / (s + c_);
  }
  double slope(double rate) const override {
    const double s = rate / fastest_, r = 1 - s / a_;
    if (s < -1) return 0;
    return (s <= 0 ? (1 + 1 / a_) / (r * r) : excess_ * c_ / ((s + c_) * (s + c_))) / fastest_;
  }

 private:
  double fastest_, a_, excess_, c_;
};

class HillVelocity : public ForceVelocity {
 public:
  static const Spec<HillVelocity>& spec() {
    using H = HillVelocity;
    static const auto s = Spec<H>()
                              .key("shortening_velocity", &H::fastest_,
                                   "Rate of the stretch at which a shortening fibre has no active stress.",
                                   {.required = true, .unit = "1/s", .range = kPositive})
                              .key("curvature", &H::curvature_,
                                   "a/F0 of Hill's hyperbola; smaller values curve it more.", {.range = kPositive})
                              .key("lengthening_factor", &H::limit_, "Limit of the factor for fast lengthening.",
                                   {.range = {1, 10, true}});
    return s;
  }
  std::shared_ptr<const RateFunction> factor() const override {
    return std::make_shared<HillFactor>(fastest_, curvature_, limit_);
  }

 private:
  double fastest_ = 0, curvature_ = 0.25, limit_ = 1.4;
};

class MeasuredRates : public RateFunction {
 public:
  explicit MeasuredRates(const std::vector<MonotoneCubic::Point>& points)
      : curve_(points, MonotoneCubic::Ends::constant, MonotoneCubic::Ends::constant) {}
  double value(double rate) const override { return curve_.value(rate); }
  double slope(double rate) const override { return curve_.slope(rate); }

 private:
  MonotoneCubic curve_;
};

class MeasuredVelocity : public ForceVelocity, public CurvePoints {
 public:
  static const Spec<MeasuredVelocity>& spec() {
    using M = MeasuredVelocity;
    static const auto s =
        Spec<M>()
            .key("points", &M::points,
                 "Pairs [rate of the stretch in 1/s, factor]; rates ascend, negative ones shorten; the factor does not "
                 "decrease, and [0, 1] is one of the pairs. Between them a monotone cubic, outside constant.")
            .key("file", &M::file, "Instead of `points`: a CSV file with the columns rate (1/s) and factor.")
            .check([](const M& velocity, const Config&) { velocity.factor(); });
    return s;
  }
  std::shared_ptr<const RateFunction> factor() const override {
    const std::vector<MonotoneCubic::Point> all = read_ascending("rate", "factor");
    const MonotoneCubic::Point rest{0, 1};
    if (std::find(all.begin(), all.end(), rest) == all.end())
      throw ConfigError(file ? file->path : origin.where,
                        "lacks the point of rate 0 and factor 1, of the isometric stress; add it");
    return std::make_shared<MeasuredRates>(all);
  }
};

const bool hill_registered =
    Registry<ForceVelocity>::add<HillVelocity>("hill",
                                               "Hill's hyperbola (1938) for shortening; a hyperbola with the same "
                                               "slope and a limit for lengthening (Zajac 1989).");
const bool rates_registered = Registry<ForceVelocity>::add<MeasuredVelocity>("table", "Through given points.");

}  // namespace
}  // namespace orthodyn
