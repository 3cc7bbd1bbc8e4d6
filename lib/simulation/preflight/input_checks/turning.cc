// Free bodies that turn: with lumped masses of wrong moments of inertia, with linear kinematics.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "lib/simulation/preflight/input_checks/subject.h"

namespace orthodyn::input_checks {

namespace {

constexpr double kFarOff = 0.02;  // of a principal moment of inertia
constexpr double kLinear = 0.1;   // rad, of linear kinematics
constexpr double kTurns = 0.05;   // rad, in the run: smaller rotations are not visible

// Second moments of a mass about its centre, integral of rho x x^T, kg m^2.
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

// Of tetrahedra with straight edges: the integral of x x^T over one is V/20 (sum x_i x_i^T + s s^T), s = sum x_i.
Moments of_the_body(const FemModel::Parts& parts) {
  const TetMesh& mesh = parts.mesh;
  Moments out;
  for (std::size_t r = 0; r < parts.elastic.size(); ++r)
    for (const int cell : parts.elastic[r]->definition().cells) {
      std::array<Vec3, 4> x;
      for (std::size_t i = 0; i < 4; ++i)
        x[i] = mesh.nodes[static_cast<std::size_t>(mesh.tets[static_cast<std::size_t>(cell)][i])];
      const double mass = parts.densities[r] * (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6;
      for (const Vec3& corner : x) out.add(mass / 20, corner);
      const Vec3 sum = x[0] + x[1] + x[2] + x[3];
      out.mass += 0.8 * mass;
      out.first += mass / 5 * sum;
      out.second += mass / 20 * sum * sum.transpose();
    }
  return out;
}

Moments of_lumped_masses(const FemModel::Parts& parts) {
  Moments out;
  for (std::size_t node = 0; node < parts.mesh.nodes.size(); ++node)
    out.add(parts.mass->nodal()[static_cast<Eigen::Index>(node)], parts.mesh.nodes[node]);
  return out;
}

// Angle (rad) by which spin at the start and loads turn the body in the run, as if it were rigid and its axes stayed.
Vec3 angle_turned(const Subject& subject) {
  const FemModel& model = *subject.built.model;
  const Moments masses = of_lumped_masses(model.parts());  // as the momenta below
  const State& start = subject.built.initial;
  const NodalExpansion nodal(model.parts(), start.t, start.q, start.v);
  const NodalVector arms = nodal.x.colwise() - Vec3(masses.first / masses.mass);
  const auto moment = [&](const NodalVector& f) {
    Vec3 sum = Vec3::Zero();
    for (Eigen::Index k = 0; k < f.cols(); ++k) sum += arms.col(k).cross(f.col(k));
    return sum;
  };
  const NodalVector momenta = nodal.u_rate * model.parts().mass->nodal().asDiagonal();
  Vec3 momentum = moment(momenta), before = Vec3::Zero(), sum = before;
  double last = subject.start();
  visit_times(subject, [&](double t) {
    const NodalExpansion then(model.parts(), t, start.q, start.v);
    NodalVector f = NodalVector::Zero(3, arms.cols());
    for (const auto& load : model.parts().loads)
      if (load->energy_kind() != EnergyKind::gravitational) load->add_force(then.state(), f);
    const Vec3 now = moment(f);
    sum += (t - last) * momentum;
    momentum += (t - last) / 2 * (before + now);
    before = now;
    last = t;
  });
  return masses.inertia().ldlt().solve(sum);
}

void add_lumped_moments(const Subject& subject, const Vec3& angle, Warnings& out) {
  const auto& parts = subject.built.model->parts();
  const Eigen::SelfAdjointEigenSolver<Mat3> exact(of_the_body(parts).inertia());
  const Mat3 axes = exact.eigenvectors(), lumped = axes.transpose() * of_lumped_masses(parts).inertia() * axes;
  const Vec3 off = lumped.diagonal().cwiseQuotient(exact.eigenvalues()) - Vec3::Ones();
  const Vec3 about = axes.transpose() * angle;
  Eigen::Index axis = 0;
  const double most = (about.array().abs() > kTurns).select(off.array().abs(), 0).matrix().maxCoeff(&axis);
  if (most <= kFarOff) return;
  out.push_back(
      fmt::format("{}: nothing holds the body, and lumped masses on so few elements have a moment of inertia "
                  "{:+.0f} % off about the axis {}: its rotation has a wrong energy there, or a wrong speed. Use "
                  "mass: consistent, or more cells",
                  subject.config.at("mesh").where(), 100 * off[axis],
                  Value<Vec3>::yaml((Vec3(axes.col(axis)) * 100).array().round() / 100 + 0.0)));
}

}  // namespace

void check_turning(const Subject& subject, Warnings& out) {
  const auto& parts = subject.built.model->parts();
  if (!subject.moves() || !is_free(subject)) return;
  const Vec3 angle = angle_turned(subject);
  if (parts.mass->lumped()) add_lumped_moments(subject, angle, out);
  const auto kinematics = value_at(subject.config, {"elasticity", "kinematics"});
  if (kinematics && kinematics->text() == "linear" && angle.norm() > kLinear)
    out.push_back(
        fmt::format("{}: nothing holds the body, and it turns by about {:.2g} rad until {:.4g} s, where linear "
                    "kinematics are for less than {} rad: it would swell. Take corotational",
                    kinematics->where(), angle.norm(), subject.end(), kLinear));
}

}  // namespace orthodyn::input_checks
