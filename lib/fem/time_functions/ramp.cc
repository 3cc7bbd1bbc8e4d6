// Time functions that rise from 0 at `start` to `value` at `end` and are constant outside.
#include <algorithm>
#include <cmath>

#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {
namespace {

class Rise : public TimeFunction {
 public:
  std::vector<double> kinks() const override { return {start_, end_}; }
  double peak(double, double) const override { return std::abs(value_); }

 protected:
  template <class T>
  static Spec<T> rise_spec() {
    return Spec<T>()
        .key("start", &T::start_, "Time until which the factor is zero.", {.unit = "s"})
        .key("end", &T::end_, "Time from which the factor is constant.", {.required = true, .unit = "s"})
        .key("value", &T::value_, "The factor reached at the end.")
        .check([](const T& rise, const Config& c) {
          if (!(rise.end_ > rise.start_)) c.fail("'end' must be after 'start'");
        });
  }
  double length() const { return end_ - start_; }
  double fraction(double t) const { return std::clamp((t - start_) / length(), 0.0, 1.0); }

  double start_ = 0, end_ = 0, value_ = 1;
};

class Ramp : public Rise {
 public:
  static const Spec<Ramp>& spec() {
    static const auto s = rise_spec<Ramp>();
    return s;
  }
  double value(double t) const override { return value_ * fraction(t); }
  double rate(double t) const override { return t >= start_ && t < end_ ? value_ / length() : 0; }
  double curvature(double) const override { return 0; }
};

// value * s^3 (10 - 15 s + 6 s^2) with s = (t - start)/(end - start) clamped to [0, 1]. The kinks are jumps of the
// third derivative.
class SmoothStep : public Rise {
 public:
  static const Spec<SmoothStep>& spec() {
    static const auto s = rise_spec<SmoothStep>();
    return s;
  }
  double value(double t) const override {
    const double s = fraction(t);
    return value_ * s * s * s * (10 - 15 * s + 6 * s * s);
  }
  double rate(double t) const override {
    const double s = fraction(t);
    return value_ / length() * 30 * s * s * (1 - s) * (1 - s);
  }
  double curvature(double t) const override {
    const double s = fraction(t);
    return value_ / (length() * length()) * 60 * s * (1 - s) * (1 - 2 * s);
  }
  bool has_continuous_rate() const override { return true; }
};

const bool ramp_registered = Registry<TimeFunction>::add<Ramp>("ramp", "Linear from zero to a value, then constant.");
const bool smooth_step_registered = Registry<TimeFunction>::add<SmoothStep>(
    "smooth_step", "From zero to a value with continuous rate and curvature (a quintic), then constant.");

}  // namespace
}  // namespace orthodyn
