#include "lib/fem/time_functions/time_function.h"

#include "lib/config/formula.h"
#include "lib/fem/differences.h"

namespace orthodyn {
namespace {

class Expression : public TimeFunction {
 public:
  static const Spec<Expression>& spec() {
    static const auto s =
        Spec<Expression>()
            .key("formula", &Expression::formula_, "The factor.", {.required = true})
            .key("kinks", &Expression::kinks_, "Times where it is not smooth; integrators restart there.",
                 {.unit = "s"})
            .key("peak", &Expression::peak_, "The largest magnitude it reaches, for default scales of errors.",
                 {.range = kNonNegative})
            .key("resolution", &Expression::resolution_,
                 "Step of the differences that give rate and curvature: a sixtieth of its shortest period, or less.",
                 {.unit = "s", .range = kPositive});
    return s;
  }
  double value(double t) const override { return formula_.at(t); }
  double rate(double t) const override { return differences(t).first; }
  double curvature(double t) const override { return differences(t).second; }
  std::vector<double> kinks() const override { return kinks_; }
  double peak() const override { return peak_; }

 private:
  Differences<double> differences(double t) const {
    return smooth_differences<double>([&](double s) { return formula_.at(s); }, t, resolution_, kinks_);
  }

  TimeFormula formula_;
  std::vector<double> kinks_;
  double peak_ = 1, resolution_ = kUsualResolution;
};

const bool expression_registered = Registry<TimeFunction>::add<Expression>("expression", "A formula of t.");

}  // namespace
}  // namespace orthodyn
