#include "lib/fem/motion/formula_motion.h"

#include "lib/fem/differences.h"

namespace orthodyn {

FormulaMotion::FormulaMotion(std::array<TimePointFormula, 3> displacement, double resolution, std::vector<double> kinks,
                             double start)
    : u_(std::move(displacement)), resolution_(resolution), kinks_(std::move(kinks)), limits_(kinks_) {
  limits_.push_back(start);
}

Moved FormulaMotion::at(double t, const NodalVector& X) const {
  Moved out{NodalVector(3, X.cols()), NodalVector(3, X.cols()), NodalVector(3, X.cols())};
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    const Vec3 rest = X.col(i);
    const auto u = [&](double time) { return Vec3(u_[0].at(time, rest), u_[1].at(time, rest), u_[2].at(time, rest)); };
    const Differences<Vec3> d = smooth_differences<Vec3>(u, t, resolution_, limits_);
    out.u.col(i) = u(t);
    out.v.col(i) = d.first;
    out.a.col(i) = d.second;
  }
  return out;
}

StepLimits FormulaMotion::step_limits(double start, double end, const NodalVector& X) const {
  StepLimits limits;
  if (X.cols() == 0) return limits;
  for (const TimePointFormula& u : u_) {
    if (!u.uses("t")) continue;
    for (const Vec3& point : {Vec3(X.leftCols<1>()), Vec3(X.rightCols<1>())})
      limits.add(StepLimits::of([&](double t) { return u.at(t, point); }, start, end, kinks_));
  }
  return limits;
}

}  // namespace orthodyn
