// A motion given by three formulas of the displacement, u(t, X). Velocity and acceleration are computed by finite
// differences of order eight and seven (differences.h), without points beyond a kink or before the start.
#include "lib/fem/motion/motion.h"

namespace orthodyn {

namespace {

class FormulaMotion : public Motion {
 public:
  FormulaMotion(std::array<TimePointFormula, 3> displacement, DifferenceStep step, std::vector<double> kinks,
                double start)
      : u_(std::move(displacement)), step_(std::move(step)), kinks_(std::move(kinks)), limits_(kinks_) {
    limits_.push_back(start);
  }

  Moved at(double t, const NodalVector& X) const override {
    const double step = step_.at(t);
    Moved out{NodalVector(3, X.cols()), NodalVector(3, X.cols()), NodalVector(3, X.cols())};
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      const Vec3 rest = X.col(i);
      const auto u = [&](double time) {
        return Vec3(u_[0].at(time, rest), u_[1].at(time, rest), u_[2].at(time, rest));
      };
      const Differences<Vec3> d = smooth_differences<Vec3>(u, t, step, limits_);
      out.u.col(i) = u(t);
      out.v.col(i) = d.first;
      out.a.col(i) = d.second;
    }
    return out;
  }

  std::vector<double> kinks() const override { return kinks_; }
  bool has_continuous_velocity() const override { return kinks_.empty(); }

  StepLimits step_limits(double start, double end, const NodalVector& X) const override {
    return step_limits_of(u_, start, end, kinks_, X);
  }

 private:
  std::array<TimePointFormula, 3> u_;
  DifferenceStep step_;
  std::vector<double> kinks_, limits_;  // limits_: kinks and start, which differences do not cross
};

}  // namespace

std::shared_ptr<const Motion> formula_motion(std::array<TimePointFormula, 3> displacement, DifferenceStep step,
                                             std::vector<double> kinks, double start) {
  return std::make_shared<FormulaMotion>(std::move(displacement), std::move(step), std::move(kinks), start);
}

StepLimits step_limits_of(const std::array<TimePointFormula, 3>& displacement, double start, double end,
                          const std::vector<double>& kinks, const NodalVector& X) {
  StepLimits limits;
  if (X.cols() == 0) return limits;
  for (const TimePointFormula& u : displacement) {
    if (!u.uses("t")) continue;
    for (const Vec3& point : {Vec3(X.leftCols<1>()), Vec3(X.rightCols<1>())})
      limits.add(StepLimits::of([&](double t) { return u.at(t, point); }, start, end, kinks));
  }
  return limits;
}

}  // namespace orthodyn
