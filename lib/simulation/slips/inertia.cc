// Bodies that are free to turn, whose lumped masses have other moments of inertia than the body itself.
#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <cmath>

#include "lib/scene/region.h"
#include "lib/simulation/slips/subject.h"

namespace orthodyn::slip {

namespace {

constexpr double kFarOff = 0.02;  // of a principal moment of inertia

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
Moments of_the_body(const Subject& subject) {
  const TetMesh& mesh = subject.built.model->parts().mesh;
  Moments out;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    std::array<Vec3, 4> x;
    for (std::size_t i = 0; i < 4; ++i) x[i] = mesh.nodes[static_cast<std::size_t>(mesh.tets[e][i])];
    const double volume = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6;
    const auto region = static_cast<std::size_t>(mesh.region_of[e]);
    const double mass = volume * material_in(subject.scene, mesh.region_names[region]).density();
    for (const Vec3& corner : x) out.add(mass / 20, corner);
    const Vec3 sum = x[0] + x[1] + x[2] + x[3];
    out.mass += mass * 0.8;
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

}  // namespace

void add_inertia_slips(const Subject& subject, Warnings& out) {
  const auto& parts = subject.built.model->parts();
  if (!subject.moves() || subject.held() || !subject.scene.motions.empty() || !parts.mass->lumped()) return;
  const Eigen::SelfAdjointEigenSolver<Mat3> exact(of_the_body(subject).inertia());
  const Mat3 lumped = exact.eigenvectors().transpose() * of_lumped_masses(parts).inertia() * exact.eigenvectors();
  Eigen::Index axis = 0;
  const Vec3 off = lumped.diagonal().cwiseQuotient(exact.eigenvalues()) - Vec3::Ones();
  if (off.cwiseAbs().maxCoeff(&axis) <= kFarOff) return;
  const Vec3 about = exact.eigenvectors().col(axis);
  out.push_back(fmt::format("{}: nothing holds the body, and lumped masses on so few elements have a moment of inertia "
                            "{:+.2g} % off about the axis {}: it turns too {} there. Use mass: consistent, or more cells",
                            subject.config.at("mesh").where(), 100 * off[axis],
                            Value<Vec3>::yaml((about * 100).array().round() / 100), off[axis] > 0 ? "slowly" : "fast"));
}

}  // namespace orthodyn::slip
