#include <algorithm>
#include <cmath>

#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {
namespace {

// From 0 at `start` to `value` at `end`, then constant.
class Ramp : public TimeFunction {
 public:
  static const Spec<Ramp>& spec() {
    static const auto s = Spec<Ramp>()
                              .key("start", &Ramp::start_, "Zero until then.", {.unit = "s"})
                              .key("end", &Ramp::end_, "Constant from then on.", {.required = true, .unit = "s"})
                              .key("value", &Ramp::value_, "The factor reached at the end.")
                              .check([](const Ramp& r, const Config& c) {
                                if (!(r.end_ > r.start_)) c.fail("'end' must be after 'start'");
                              });
    return s;
  }
  double value(double t) const override { return value_ * std::clamp((t - start_) / (end_ - start_), 0.0, 1.0); }
  double rate(double t) const override { return t >= start_ && t < end_ ? value_ / (end_ - start_) : 0; }
  double curvature(double) const override { return 0; }
  std::vector<double> kinks() const override { return {start_, end_}; }
  double peak(double, double) const override { return std::abs(value_); }

 private:
  double start_ = 0, end_ = 0, value_ = 1;
};

const bool ramp_registered = Registry<TimeFunction>::add<Ramp>("ramp", "Linear from zero to a value, then constant.");

}  // namespace
}  // namespace orthodyn
