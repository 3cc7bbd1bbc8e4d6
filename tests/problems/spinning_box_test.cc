// A box spinning about axis 3 with zero Poisson ratios: an exact solution of the nonlinear
// corotational model. In the rotating frame F stays diagonal and E_i x_i'' + rho w^2 x_i = 0 with free
// ends: x_i = sin(k_i X) / (k_i cos(k_i L_i / 2)), k_i = w sqrt(rho / E_i); x_3 = X.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/problems/running.h"

namespace orthodyn::spinning_box_test {
namespace {

constexpr double kOmega = 4;
const Vec3 kSize{2, 1, 0.2}, kYoung{100, 30, 10};

BuiltTestScene box(int n, const std::string& end = "1") {
  return BuiltTestScene(fmt::format(R"(
mesh: {{type: box, size: [2, 1, 0.2], cells: [{}, {}, {}], origin: [-1, -0.5, -0.1], order: 1}}
materials: {{m: {{type: orthotropic, density: 1, young: [100, 30, 10], nu12: 0, nu23: 0, nu13: 0, g12: 20, g23: 8, g13: 15}}}}
mass: consistent
integrator: {{type: cvode_bdf, rtol: 1e-5, max_order: 2}}
time: {{end: {}}}
)",
                                    n, n / 2, std::max(1, n / 8), end));
}

Vec3 exact(const Vec3& X) {
  Vec3 x = X;
  for (int i = 0; i < 2; ++i) {
    const double k = kOmega / std::sqrt(kYoung[i]);
    x[i] = std::sin(k * X[i]) / (k * std::cos(k * kSize[i] / 2));
  }
  return x;
}

Vector exact_dofs(const BuiltTestScene& s) {
  return s.dofs([](const Vec3& X) { return Vec3(exact(X) - X); });
}

// Residual M w^2 x + f(x) in the plane of rotation, tested with smooth functions (x_i itself), relative to the
// centrifugal term.
double weak_residual(int n) {
  const auto scene = box(n);
  const Vector q = exact_dofs(scene);
  const Vector x = scene.dofs([](const Vec3& X) { return Vec3(exact(X)[0], exact(X)[1], 0); });
  Vector centrifugal(x.size());
  scene.model().multiply_mass(kOmega * kOmega * x, centrifugal);
  const Vector residual = centrifugal + scene.force(q);
  return std::abs(residual.dot(x)) / centrifugal.dot(x);
}

// Equilibrium in the rotating frame, f(q) + w^2 M x = 0 with x in the plane of rotation, by Newton from the rest shape.
// Rotation about axis 3 and translation along it are undetermined; the minimum-norm correction excludes both.
Vector equilibrium_in_rotation(const BuiltTestScene& scene) {
  const Vector in_plane = scene.dofs([](const Vec3&) { return Vec3(1, 1, 0); });
  const Vector rest = scene.dofs([](const Vec3& X) { return X; });
  const Eigen::MatrixXd centrifugal = kOmega * kOmega * scene.mass() * in_plane.asDiagonal();
  Vector q = scene.zero();
  for (int i = 0; i < 6; ++i) {
    const Vector residual = scene.force(q) + centrifugal * (rest + q);
    q += (scene.stiffness(q) - centrifugal).completeOrthogonalDecomposition().solve(residual);
  }
  return q;
}

double tip(int n) {
  const auto scene = box(n);
  const Vector q = equilibrium_in_rotation(scene);
  return scene.positions(q).row(0).maxCoeff();
}

// At X = 1 m with k = w sqrt(rho / E_1) = 0.4 /m. At the corners of the face the error of linear elements falls at
// least with their size.
TEST(SpinningBox, TheModelStretchesAsTheExactSolutionSays) {
  const double expected = std::tan(0.4) / 0.4;
  EXPECT_NEAR(exact({1, 0, 0})[0], expected, 1e-12);
  const double coarse = std::abs(tip(4) - expected), fine = std::abs(tip(8) - expected);
  EXPECT_LT(fine, 0.02 * (expected - 1));
  EXPECT_GT(std::log2(coarse / fine), 0.9) << coarse << " " << fine;
  EXPECT_LT(std::log2(coarse / fine), 2.1) << coarse << " " << fine;
}

TEST(SpinningBox, ExactSolutionLeavesAResidualOfSecondOrder) {
  const double coarse = weak_residual(8), fine = weak_residual(16);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1) << coarse << " " << fine;
  EXPECT_LE(fine, 1e-3);
}

// Half a revolution from the exact state: the shape may differ by the discretisation error, 3.4 % of
// the largest displacement at n = 16, twice that as it swings about its equilibrium.
TEST(SpinningBox, RotatesRigidlyForHalfARevolution) {
  auto scene = box(16, fmt::format("{}", std::numbers::pi / kOmega));
  scene.built.initial.q = exact_dofs(scene);
  scene.built.initial.v = scene.dofs([](const Vec3& X) { return Vec3(kOmega * Vec3::UnitZ().cross(exact(X))); });
  const NodalVector start = scene.positions(scene.built.initial.q);
  const double largest_u = scene.built.initial.q.lpNorm<Eigen::Infinity>();
  double largest = 0;
  const auto outcome = run_scene(scene, 20, [&](const State& state) {
    const Mat3 R = Eigen::AngleAxisd(kOmega * state.t, Vec3::UnitZ()).toRotationMatrix();
    largest = std::max(largest, (scene.positions(state.q) - R * start).colwise().norm().maxCoeff());
  });
  EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
  EXPECT_LE(largest, 0.07 * largest_u);
}

}  // namespace
}  // namespace orthodyn::spinning_box_test
