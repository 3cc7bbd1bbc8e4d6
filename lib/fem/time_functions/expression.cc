#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/config/formula.h"
#include "lib/core/errors.h"
#include "lib/core/golden_ratio_sample.h"
#include "lib/fem/differences.h"
#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {
namespace {

class Expression : public TimeFunction {
 public:
  static const Spec<Expression>& spec() {
    static const auto s =
        Spec<Expression>()
            .key("formula", &Expression::formula_, "The factor.", {.required = true})
            .key("kinks", &Expression::kinks_, "Times where the formula is not smooth; integrators restart there.",
                 {.unit = "s"})
            .key(
                "peak", &Expression::peak_,
                "Largest magnitude, for default error scales; default: the largest of 100,000 values in the time span.",
                {.range = kNonNegative})
            .key("resolution", &Expression::resolution_,
                 "Step of the finite differences for rate and curvature: at most 1/60 of the shortest period; default: "
                 "chosen from the formula's course over the time span.",
                 {.unit = "s", .range = kPositive});
    return s;
  }
  double value(double t) const override { return formula_.at(t); }
  double rate(double t) const override { return differences(t).first; }
  double curvature(double t) const override { return differences(t).second; }
  std::vector<double> kinks() const override { return kinks_; }
  std::shared_ptr<const TimeFunction> over(double start, double end) const override {
    if (resolution_ || !(end > start)) return nullptr;
    auto resolved = std::make_shared<Expression>(*this);
    resolved->step_ = DifferenceStep(step_limits(start, end), start, end);
    return resolved;
  }
  StepLimits step_limits(double start, double end) const override {
    return StepLimits::of([this](double t) { return formula_.at(t); }, start, end, kinks_);
  }
  double peak(double start, double end) const override {
    if (peak_) return *peak_;
    constexpr int kSamples = 100'000;
    double largest = 0;
    for (int k = 0; k <= kSamples; ++k) {
      try {
        largest = std::max(largest,
                           std::abs(formula_.at(k < kSamples ? start + golden_ratio_sample(k) * (end - start) : end)));
      } catch (const ConfigError&) {  // no value at this time; the run reports this if it reaches the time
      }
    }
    return largest;
  }

 private:
  Differences<double> differences(double t) const {
    const double step = resolution_ ? *resolution_ : step_.at(t);
    return smooth_differences<double>([&](double s) { return formula_.at(s); }, t, step, kinks_);
  }

  TimeFormula formula_;
  std::vector<double> kinks_;
  std::optional<double> peak_;
  std::optional<double> resolution_;
  DifferenceStep step_{1e-3};  // s; used if the time span is unknown
};

const bool expression_registered = Registry<TimeFunction>::add<Expression>("expression", "A formula of t.");

}  // namespace
}  // namespace orthodyn
