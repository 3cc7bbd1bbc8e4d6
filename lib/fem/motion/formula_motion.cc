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

}  // namespace orthodyn
