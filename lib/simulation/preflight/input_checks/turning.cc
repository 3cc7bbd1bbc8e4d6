// Free rotation: lumped masses with wrong moments of inertia, and linear kinematics.

#include <Eigen/Eigenvalues>
#include <cmath>

#include "lib/fem/element_mesh.h"
#include "lib/simulation/preflight/input_checks/check_context.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kFarOff = 0.02;  // relative error of a principal moment of inertia
constexpr double kLinear = 0.1;   // largest rotation for linear kinematics, rad
constexpr double kTurns = 0.05;   // rotation during the run, rad; smaller ones are invisible

// Mass (kg), first moment (integral of rho x, kg m) and second moment (integral of rho x x^T, kg m^2).
struct Moments {
  double mass = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();

  void add(double m, const Vec3& x) {
    mass += m;
    first += m * x;
    second += m * x * x.transpose();
  }
  Mat3 inertia() const {
    const Mat3 about_centre = second - first * first.transpose() / mass;
    return about_centre.trace() * Mat3::Identity() - about_centre;
  }
};

// The consistent mass M integrates rho N_a N_b, so that the integral of rho x x^T is sum M_ab x_a x_b^T.
Moments of_the_body(const FemModel::Parts& parts) {
  const ElementMesh mesh(parts.mesh);
  Moments out;
  for (std::size_t r = 0; r < parts.elastic.size(); ++r) {
    const double density = parts.densities[r] * parts.elastic[r]->definition().share;
    for (const int cell : parts.elastic[r]->definition().cells) {
      const auto c = static_cast<std::size_t>(cell);
      const ElementType::Nodes X = mesh.positions(c);
      const Eigen::MatrixXd M = mesh.type(c).consistent_mass(X, density);
      out.mass += M.sum();
      out.first += X * M.rowwise().sum();
      out.second += X * M * X.transpose();
    }
  }
  return out;
}

Moments of_lumped_masses(const FemModel::Parts& parts) {
  Moments out;
  for (std::size_t node = 0; node < parts.mesh.nodes.size(); ++node)
    out.add(parts.mass->nodal()[static_cast<Eigen::Index>(node)], parts.mesh.nodes[node]);
  return out;
}

// Rotation (rad) during the run by the initial spin and the loads, as if the body were rigid and its axes fixed.
Vec3 angle_turned(const CheckContext& context) {
  const FemModel& model = *context.built.model;
  const Moments masses = of_lumped_masses(model.parts());  // lumped like the mass of the momenta below
  const State& start = context.built.initial;
  const NodalExpansion nodal(model.parts(), start.t, start.q, start.v);
  const NodalVector arms = nodal.x.colwise() - Vec3(masses.first / masses.mass);
  const auto moment = [&](const NodalVector& f) {
    Vec3 sum = Vec3::Zero();
    for (Eigen::Index k = 0; k < f.cols(); ++k) sum += arms.col(k).cross(f.col(k));
    return sum;
  };
  const NodalVector momenta = nodal.u_rate * model.parts().mass->nodal().asDiagonal();
  Vec3 momentum = moment(momenta), before = Vec3::Zero(), sum = before;
  double last = context.start();
  visit_times(context, [&](double t) {
    const NodalExpansion then(model.parts(), t, start.q, start.v);
    const Vec3 now = moment(load_forces(model.parts(), then));
    sum += (t - last) * momentum;
    momentum += (t - last) / 2 * (before + now);
    before = now;
    last = t;
  });
  return masses.inertia().ldlt().solve(sum);
}

void add_lumped_moments(const CheckContext& context, const Vec3& angle, Warnings& out) {
  const auto& parts = context.built.model->parts();
  const Eigen::SelfAdjointEigenSolver<Mat3> exact(of_the_body(parts).inertia());
  const Mat3 axes = exact.eigenvectors(), lumped = axes.transpose() * of_lumped_masses(parts).inertia() * axes;
  const Vec3 off = lumped.diagonal().cwiseQuotient(exact.eigenvalues()) - Vec3::Ones();
  const Vec3 about = axes.transpose() * angle;
  Eigen::Index axis = 0;
  const double most = (about.array().abs() > kTurns).select(off.array().abs(), 0).matrix().maxCoeff(&axis);
  if (most <= kFarOff) return;
  warn(out, context.config.at("mesh").where(),
       "nothing holds the body, and lumped masses on so few elements give a moment of inertia {:+.0f} % off about the "
       "axis {}: the energy or speed of its rotation is wrong. Use mass: consistent, or more cells",
       100 * off[axis], Value<Vec3>::yaml((Vec3(axes.col(axis)) * 100).array().round() / 100 + 0.0));
}

}  // namespace

void check_turning(const CheckContext& context, Warnings& out) {
  const auto& parts = context.built.model->parts();
  if (!context.is_timed_motion() || !is_free(context)) return;
  const Vec3 angle = angle_turned(context);
  if (parts.mass->lumped()) add_lumped_moments(context, angle, out);
  const auto kinematics = find_value(context.config, {"elasticity", "kinematics"});
  if (kinematics && kinematics->text() == "linear" && angle.norm() > kLinear)
    warn(out, kinematics->where(),
         "nothing holds the body, and it turns by about {:.2g} rad until {:.4g} s, but linear kinematics are limited "
         "to {} rad: the body would swell. Use corotational",
         angle.norm(), context.end(), kLinear);
}

}  // namespace orthodyn::input_checks
