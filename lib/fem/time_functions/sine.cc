#include <cmath>
#include <numbers>

#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {
namespace {

class Sine : public TimeFunction {
 public:
  static const Spec<Sine>& spec() {
    static const auto s =
        Spec<Sine>()
            .key("frequency", &Sine::frequency_, "Frequency.", {.required = true, .unit = "Hz", .range = kPositive})
            .key("amplitude", &Sine::amplitude_, "The factor's amplitude.")
            .key("phase", &Sine::phase_, "sin(2 pi frequency t + phase).", {.unit = "rad"});
    return s;
  }
  double value(double t) const override { return amplitude_ * std::sin(omega() * t + phase_); }
  double rate(double t) const override { return amplitude_ * omega() * std::cos(omega() * t + phase_); }
  double curvature(double t) const override { return -omega() * omega() * value(t); }
  StepLimits step_limits(double, double) const override { return StepLimits(0.25 / frequency_); }
  double peak(double, double) const override { return std::abs(amplitude_); }

 private:
  double omega() const { return 2 * std::numbers::pi * frequency_; }

  double frequency_ = 0, amplitude_ = 1, phase_ = 0;
};

const bool sine_registered = Registry<TimeFunction>::add<Sine>("sine", "A sine.");

}  // namespace
}  // namespace orthodyn
