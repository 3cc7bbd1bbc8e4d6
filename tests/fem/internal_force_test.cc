// Properties of internal forces for any body: zero at rest and after rigid motion, balanced, exact for affine motion,
// independent of units and of the frame.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "lib/core/symmetric_eigen.h"
#include "lib/mesh/box.h"
#include "tests/fem/built_scene.h"
#include "tests/mesh/tets.h"

namespace orthodyn::internal_force_test {
namespace {

BuiltTestScene body(const Mesh& mesh, const std::string& material, const std::string& corotation = "exact",
                    const Mat3& axes = Mat3::Identity()) {
  given_mesh() = mesh;
  const auto text = [](const Vec3& v) { return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]); };
  return BuiltTestScene(fmt::format(R"(
mesh: {{type: given}}
materials: {{m: {}}}
regions: {{body: {{material: m, axes: {{first: {}, second: {}}}}}}}
elasticity: {{corotation: {}}}
time: {{end: 1}}
)",
                                    material, text(axes.col(0)), text(axes.col(1)), corotation));
}

const Mesh kBlock = make_box({.size = {2, 1, 1}, .cells = {2, 2, 1}});

Mat3 edges_of(const Mesh& mesh, const Tet& tet) {
  Mat3 e;
  for (int k = 0; k < 3; ++k)
    e.col(k) = mesh.nodes[static_cast<std::size_t>(tet[static_cast<std::size_t>(k) + 1])] -
               mesh.nodes[static_cast<std::size_t>(tet[0])];
  return e;
}

// Gradients of the four shape functions as columns, 1/m.
Eigen::Matrix<double, 3, 4> gradients(const Mat3& edges) {
  Eigen::Matrix<double, 3, 4> g;
  g.rightCols<3>() = edges.inverse().transpose();
  g.col(0) = -g.rightCols<3>().rowwise().sum();
  return g;
}

double smallest_height(const Mesh& mesh) {
  double largest = 0;
  for (const Tet& tet : tets_of(mesh))
    largest = std::max(largest, gradients(edges_of(mesh, tet)).colwise().norm().maxCoeff());
  return 1 / largest;
}

// max |f_i| / f_ref,i with f_ref,i = Cmax sum_e V_e |g_i|, in units of eps max(1, |x|max / h_min).
double null_force(const BuiltTestScene& s, const Vector& q, double c_max) {
  Vector reference = Vector::Zero(static_cast<Eigen::Index>(s.mesh().nodes.size()));
  for (const Tet& tet : tets_of(s.mesh())) {
    const Mat3 e = edges_of(s.mesh(), tet);
    const auto g = gradients(e);
    for (int a = 0; a < 4; ++a)
      reference[tet[static_cast<std::size_t>(a)]] += c_max * e.determinant() / 6 * g.col(a).norm();
  }
  const NodalVector f = s.nodal(s.force(q));
  const double far = s.positions(q).colwise().norm().maxCoeff();
  return (f.colwise().norm().transpose().array() / reference.array()).maxCoeff() /
         (kEps * std::max(1.0, far / smallest_height(s.mesh())));
}

double largest_modulus(double ratio) {
  return voigt(stiffness(stable_family({ratio, 1, 1}, 0.3))).cwiseAbs().maxCoeff();
}

// Row 1.
TEST(InternalForce, VanishesAtRestAndAfterRigidMotionToRoundOff) {
  Random random(111);
  for (const double ratio : {1.0, 10.0, 1e6})
    for (const double offset : {0.0, 1.0, 1e3}) {
      const auto s = body(kBlock, fibre_material(ratio), "exact", random.rotation());
      EXPECT_LE(null_force(s, s.zero(), largest_modulus(ratio)), 4) << ratio;
      const Mat3 R = random.rotation();
      const Vec3 shift = offset * Vec3(1, -0.5, 0.3);
      const Vector q = s.dofs([&](const Vec3& X) { return Vec3(R * X + shift - X); });
      EXPECT_LE(null_force(s, q, largest_modulus(ratio)), 4) << ratio << " at " << offset;
    }
}

// One tetrahedron, nearly flat, with a dihedral angle of this many degrees.
Mesh sliver(double degrees) {
  const double height = 0.4 * std::tan(degrees * std::numbers::pi / 180);
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0.3, 0.9, 0}, {0.4, 0.4, height}};
  mesh.cells = Cells(std::vector<Tet>{{0, 1, 2, 3}});
  mesh.region_of = {0};
  mesh.region_names = {"body"};
  return mesh;
}

// Row 2.
TEST(InternalForce, OfASliverVanishesAfterARotationAndItsFrequencyIsThatOfItsHeight) {
  Random random(112);
  for (const double degrees : {10.0, 1.0, 0.1, 0.01}) {
    const auto s = body(sliver(degrees), fibre_material(10), "exact", random.rotation());
    for (int sample = 0; sample < 5; ++sample) {
      const Mat3 R = random.rotation();
      const Vector q = s.dofs([&](const Vec3& X) { return Vec3(R * X - X); });
      EXPECT_LE(null_force(s, q, largest_modulus(10)), 4) << degrees;
    }
    const Mat6 C = mandel(voigt(stiffness(stable_family({10, 1, 1}, 0.3))));
    const double c_p = std::sqrt(symmetric_eigenvalues(C)[5]);
    const double omega = std::sqrt(s.model().parts().elastic[0]->max_frequency_squared(1));
    const double scaled = omega * smallest_height(s.mesh()) / c_p;
    EXPECT_GE(scaled, 0.3) << degrees;  // 1 if the stiff axis stands across the sliver
    EXPECT_LE(scaled, 3.6) << degrees;
  }
}

// Irons: no element is stiffer than the whole mesh.
TEST(InternalForce, FrequencyBoundOfTheElementsHoldsForTheMesh) {
  const auto s = body(kBlock, fibre_material(10));
  const double highest = symmetric_eigenvalues(s.stiffness(s.zero()), s.mass())[s.size() - 1];
  const double bound = s.model().parts().elastic[0]->max_frequency_squared(1);
  EXPECT_LE(highest, bound);
  EXPECT_GE(highest, 0.2 * bound);
}

// Row 3: rest positions of the inner nodes at random, affine motion of all nodes.
TEST(PatchTest, AnAffineMotionLeavesNoForceOnInnerNodes) {
  Random random(113);
  Mesh mesh = make_box({.cells = {4, 4, 4}});
  std::vector<bool> inner(mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    inner[i] = (mesh.nodes[i].array() > 0.01).all() && (mesh.nodes[i].array() < 0.99).all();
    if (inner[i]) mesh.nodes[i] += 0.04 * random.vector();
  }
  for (const double ratio : {1.0, 10.0, 1000.0}) {
    const auto s = body(mesh, fibre_material(ratio), "exact", random.rotation());
    const double strain = ratio > 100 ? 0.01 : 0.05;  // half of where the law stops being elliptic
    const Mat3 U = Mat3::Identity() + strain * (Mat3() << 1, 0.3, 0, 0.3, -0.5, 0.2, 0, 0.2, 0.4).finished();
    const Mat3 A = random.rotation() * U;
    const NodalVector f = s.nodal(s.force(s.dofs([&](const Vec3& X) { return Vec3(A * X - X); })));
    double inside = 0, outside = 0;
    for (std::size_t i = 0; i < inner.size(); ++i)
      (inner[i] ? inside : outside) = std::max(inner[i] ? inside : outside, f.col(static_cast<Eigen::Index>(i)).norm());
    // Row 1's 4 eps |x| / h_min, where |x| / h_min is about 20, on a stress of the order of the strain.
    EXPECT_LE(inside, 4 * 2.2e-16 * 20 / strain * outside) << ratio;
  }
}

struct Balance {
  double force, torque;  // relative to max |f| and to sum |f| |x|
};

Balance balance(const BuiltTestScene& s, const Vector& q) {
  const NodalVector f = s.nodal(s.force(q)), x = s.positions(q);
  Vec3 torque = Vec3::Zero();
  double size = 0;
  for (Eigen::Index i = 0; i < f.cols(); ++i) {
    torque += x.col(i).cross(f.col(i));
    size += x.col(i).norm() * f.col(i).norm();
  }
  return {f.rowwise().sum().norm() / f.colwise().norm().maxCoeff(), torque.norm() / size};
}

// Row 5, inverted elements included.
TEST(InternalForce, OfAnyDeformationIsInBalance) {
  Random random(114);
  for (const double ratio : {1.0, 10.0, 100.0})
    for (const double amplitude : {0.05, 0.2, 1.0}) {
      const auto s = body(kBlock, fibre_material(ratio), "exact", random.rotation());
      const auto found = balance(s, random_dofs(random, s.size(), amplitude));
      EXPECT_LE(found.force, 1e-13) << ratio << " " << amplitude;
      EXPECT_LE(found.torque, 1e-13) << ratio << " " << amplitude;
    }
}

TEST(WarpedForce, ExertsANetTorqueButNoNetForce) {
  Random random(115);
  const auto s = body(kBlock, fibre_material(10), "warped", random.rotation());
  Mat3 F = Mat3::Identity();
  F(0, 0) = 1.2;
  const auto found = balance(s, s.dofs([&](const Vec3& X) { return Vec3(F * X - X); }));
  EXPECT_LE(found.force, 1e-13);
  EXPECT_GE(found.torque, 1e-3);
}

// Row 6. The textbook force is -V R (2 mu e + lambda tr(e) I) g_a with R from a singular value
// decomposition.
TEST(IsotropicForce, IsTheTextbooksAndTheWarpedOne) {
  Random random(116);
  const std::string material = "{type: isotropic, density: 1, young: 2, nu: 0.3}";
  const double mu = 2 / (2 * 1.3), lambda = 2 * 0.3 / (1.3 * 0.4);
  const auto exact = body(kBlock, material), warped = body(kBlock, material, "warped");
  const Vector q = random_dofs(random, exact.size(), 0.1);
  const NodalVector x = exact.positions(q);
  NodalVector expected = NodalVector::Zero(3, x.cols());
  for (const Tet& tet : tets_of(exact.mesh())) {
    const Mat3 rest = edges_of(exact.mesh(), tet);
    Mat3 now;
    for (int k = 0; k < 3; ++k) now.col(k) = x.col(tet[static_cast<std::size_t>(k) + 1]) - x.col(tet[0]);
    const Mat3 F = now * rest.inverse();
    ASSERT_GT(F.determinant(), 0);
    const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Mat3 R = svd.matrixU() * svd.matrixV().transpose(), e = R.transpose() * F - Mat3::Identity();
    const Mat3 P = R * (2 * mu * e + lambda * e.trace() * Mat3::Identity());
    const auto g = gradients(rest);
    for (int a = 0; a < 4; ++a) expected.col(tet[static_cast<std::size_t>(a)]) -= rest.determinant() / 6 * P * g.col(a);
  }
  EXPECT_LE((exact.nodal(exact.force(q)) - expected).norm(), 1e-13 * expected.norm());
  EXPECT_LE((warped.nodal(warped.force(q)) - expected).norm(), 1e-13 * expected.norm());
}

// Row 20: force goes with length^2, K with length, the null force with neither.
TEST(InternalForce, KnowsNoUnitOfLength) {
  Random random(117);
  const auto unit = body(kBlock, fibre_material(10));
  const Vector q = random_dofs(random, unit.size(), 0.1);
  const Vector f = unit.force(q);
  const Eigen::MatrixXd K = unit.stiffness(q);
  for (const double scale : {1e7, 1e-7}) {
    Mesh mesh = kBlock;
    for (Vec3& X : mesh.nodes) X *= scale;
    const auto s = body(mesh, fibre_material(10));
    EXPECT_LE((s.force(scale * q) / (scale * scale) - f).norm(), 1e-12 * f.norm()) << scale;
    EXPECT_LE((s.stiffness(scale * q) / scale - K).norm(), 1e-12 * K.norm()) << scale;
  }
}

TEST(InternalForce, KnowsNoUnitOfStress) {
  Random random(118);
  const auto unit = body(kBlock, "{type: orthotropic_stable, density: 1, young: [10, 2, 1], nu: 0.3}");
  const Vector q = random_dofs(random, unit.size(), 0.3), f = unit.force(q);
  for (const char* power : {"e12", "e-12"}) {
    const auto s = body(
        kBlock, fmt::format("{{type: orthotropic_stable, density: 1, young: [10{0}, 2{0}, 1{0}], nu: 0.3}}", power));
    EXPECT_LE((s.force(q) / std::stod("1" + std::string(power)) - f).norm(), 1e-12 * f.norm());
  }
}

// Row 21.
TEST(InternalForce, TurnsWithTheWholeProblem) {
  Random random(119);
  for (const double amplitude : {0.1, 0.6}) {
    const Mat3 R = random.rotation(), Q = random.rotation();
    Mesh turned = kBlock;
    for (Vec3& X : turned.nodes) X = R * X;
    const auto here = body(kBlock, fibre_material(10), "exact", Q);
    const auto there = body(turned, fibre_material(10), "exact", R * Q);
    const Vector q = random_dofs(random, here.size(), amplitude);
    const NodalVector u = R * here.nodal(q);
    const Vector turned_q = u.reshaped();
    const NodalVector expected = R * here.nodal(here.force(q));
    EXPECT_LE((there.nodal(there.force(turned_q)) - expected).norm(), 1e-13 * expected.norm()) << amplitude;
    EXPECT_NEAR(there.potential(turned_q), here.potential(q), 1e-13 * here.potential(q));
  }
}

}  // namespace
}  // namespace orthodyn::internal_force_test
