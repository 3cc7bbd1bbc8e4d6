#include <cmath>

#include "lib/fem/time_functions/time_function.h"

namespace orthodyn {
namespace {

class Constant : public TimeFunction {
 public:
  static const Spec<Constant>& spec() {
    static const auto s = Spec<Constant>().key("value", &Constant::value_, "The factor.");
    return s;
  }
  double value(double) const override { return value_; }
  double rate(double) const override { return 0; }
  double curvature(double) const override { return 0; }
  bool constant() const override { return true; }
  double peak(double, double) const override { return std::abs(value_); }

 private:
  double value_ = 1;
};

const bool constant_registered = Registry<TimeFunction>::add<Constant>("constant", "The same at all times.");

}  // namespace
}  // namespace orthodyn
