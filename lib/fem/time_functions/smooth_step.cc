#include <algorithm>
#include <cmath>

#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {
namespace {

// value s^3 (10 - 15 s + 6 s^2), s = (t - start)/(end - start) in [0, 1]: rate and curvature vanish at both ends.
class SmoothStep : public TimeFunction {
 public:
  static const Spec<SmoothStep>& spec() {
    static const auto s = Spec<SmoothStep>()
                              .key("start", &SmoothStep::start_, "Zero until then.", {.unit = "s"})
                              .key("end", &SmoothStep::end_, "Constant from then on.", {.required = true, .unit = "s"})
                              .key("value", &SmoothStep::value_, "The factor reached at the end.")
                              .check([](const SmoothStep& f, const Config& c) {
                                if (!(f.end_ > f.start_)) c.fail("'end' must be after 'start'");
                              });
    return s;
  }
  double value(double t) const override {
    const double s = along(t);
    return value_ * s * s * s * (10 - 15 * s + 6 * s * s);
  }
  double rate(double t) const override {
    const double s = along(t);
    return value_ / length() * 30 * s * s * (1 - s) * (1 - s);
  }
  double curvature(double t) const override {
    const double s = along(t);
    return value_ / (length() * length()) * 60 * s * (1 - s) * (1 - 2 * s);
  }
  std::vector<double> kinks() const override { return {start_, end_}; }  // of the third derivative
  bool has_continuous_rate() const override { return true; }
  double peak(double, double) const override { return std::abs(value_); }

 private:
  double length() const { return end_ - start_; }
  double along(double t) const { return std::clamp((t - start_) / length(), 0.0, 1.0); }

  double start_ = 0, end_ = 0, value_ = 1;
};

const bool smooth_step_registered = Registry<TimeFunction>::add<SmoothStep>(
    "smooth_step", "From zero to a value with continuous rate and curvature (a quintic), then constant.");

}  // namespace
}  // namespace orthodyn
