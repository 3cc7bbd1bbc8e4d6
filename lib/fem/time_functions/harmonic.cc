// The time function `harmonic`: a load of a harmonic analysis, amplitude cos(omega t + phase) at each of its
// frequencies omega.
#include <cmath>

#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {
namespace {

class Harmonic : public TimeFunction {
 public:
  static const Spec<Harmonic>& spec() {
    static const auto s = Spec<Harmonic>()
                              .key("amplitude", &Harmonic::amplitude_, "The factor's amplitude.")
                              .key("phase", &Harmonic::phase_, "cos(2 pi frequency t + phase).", {.unit = "rad"});
    return s;
  }
  bool is_harmonic() const override { return true; }
  double value(double t) const override {
    if (t == kRealPart) return amplitude_ * std::cos(phase_);
    if (t == kImaginaryPart) return amplitude_ * std::sin(phase_);
    return 0;
  }
  double rate(double) const override { return 0; }
  double curvature(double) const override { return 0; }
  double peak(double, double) const override { return std::abs(amplitude_); }

 private:
  double amplitude_ = 1, phase_ = 0;
};

const bool harmonic_registered = Registry<TimeFunction>::add<Harmonic>(
    "harmonic", "A vibration at each frequency of a harmonic analysis (analysis: harmonic).");

}  // namespace
}  // namespace orthodyn
