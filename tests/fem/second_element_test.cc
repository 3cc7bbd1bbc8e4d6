// lib/fem with an element of another shape, with more nodes and points than the tetrahedron: no code depends on the
// element types.
#include <gtest/gtest.h>

#include "lib/fem/element_type_of.h"
#include "lib/fem/mass.h"
#include "tests/element/states.h"
#include "tests/fem/hex8.h"

namespace orthodyn::second_element_test {
namespace {

constexpr double kDensity = 3, kBeta = 0.2;
const Vec3 kSize(2, 0.5, 1);

// Two bricks in a row, sheared, with free nodes.
class Bricks : public testing::Test {
 protected:
  Bricks() {
    for (int layer = 0; layer < 3; ++layer)
      for (int a = 0; a < 4; ++a) {
        const Vec3 corner = (Vec3::Ones() + Hex8::corner(a)) / 2;
        nodes.push_back(shear * kSize.cwiseProduct(Vec3(corner[0], corner[1], 0.5 * layer)));
      }
    std::vector<int> all;
    for (int k = 0; k < 16; ++k) all.push_back(k < 8 ? k : k - 4);
    mesh.cells = Cells(Hex8::kNodes, all);
    for (int i = 0; i < x.cols(); ++i) rest.col(i) = nodes[static_cast<std::size_t>(i)];
    x = rest;
    for (int i = 0; i < x.size(); ++i) {
      x(i) += random.between(-0.05, 0.05);
      v(i) = random.between(-1, 1);
    }
  }

  std::unique_ptr<ElasticTerm> term(ElasticityOptions options = {}) const {
    return type.elastic_term(mesh, {"bricks", {0, 1}, fibre(10), random_axes, kBeta, options}, pattern);
  }
  struct Placed {
    NodalVector x, u, v;
    operator NodalState() const { return {0, x, u, v}; }  // NOLINT: passed as one
  };
  Placed at(const NodalVector& positions, const NodalVector& velocities) const {
    return {positions, positions - rest, velocities};
  }
  Eigen::MatrixXd full(const std::vector<double>& values) const {
    return Eigen::MatrixXd(Eigen::MatrixXd(pattern.pattern().matrix(values.data())).selfadjointView<Eigen::Lower>());
  }
  Eigen::MatrixXd matrix_of(const Mass& mass) const {
    std::vector<double> values(pattern.pattern().row.size(), 0);
    mass.add_to(1, values.data());
    return full(values);
  }

  static constexpr int kNumNodes = 12;
  ElementTypeOf<Hex8> type;
  Mat3 shear = (Mat3() << 1, 0.3, 0, 0, 1, 0.2, 0, 0, 1).finished();
  std::vector<Vec3> nodes;
  ElementMesh mesh{type, nodes, {}};
  DofMap dofs{kNumNodes, std::vector<bool>(3 * kNumNodes, false)};
  Random random{301};
  Mat3 random_axes = random.rotation();
  NodalVector rest{3, kNumNodes}, x{3, kNumNodes}, v{3, kNumNodes};
  BlockPattern pattern{Cells(Hex8::kNodes, {0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8, 9, 10, 11}), dofs, true};
};

TEST_F(Bricks, HaveTheirMass) {
  for (const auto kind : {MassKind::lumped, MassKind::consistent}) {
    const Mass mass(kind, mesh, {kDensity, kDensity}, dofs, pattern);
    EXPECT_NEAR(mass.total(), kDensity * kSize.prod(), 64 * kEps * kDensity);
    EXPECT_NEAR(matrix_of(mass).sum(), 3 * kDensity * kSize.prod(), 1e-13 * kDensity);
  }
}

// Rates linear in space are represented exactly: integral of z^2 over the box.
TEST_F(Bricks, HaveTheConsistentMassOfLinearFields) {
  const Mass mass(MassKind::consistent, mesh, {kDensity, kDensity}, dofs, pattern);
  Vector z = Vector::Zero(3 * kNumNodes);
  for (int i = 0; i < kNumNodes; ++i) z[3 * i] = rest(2, i);
  Vector Mz(z.size());
  mass.multiply(z, Mz);
  EXPECT_NEAR(z.dot(Mz), kDensity * kSize.prod() * kSize[2] * kSize[2] / 3, 1e-13);
}

TEST_F(Bricks, GiveAnAffineMapItsEnergy) {
  const Mat3 F = random_strain(random, 0.1).F();
  const NodalVector moved = F * rest, still = NodalVector::Zero(3, kNumNodes);
  const double energy =
      CorotationalLaw(fibre(10)).energy<double>((F - Mat3::Identity()) * random_axes, random_axes) * kSize.prod();
  EXPECT_NEAR(term()->energy(at(moved, still)), energy, 1e-12 * energy);
  EXPECT_NEAR(term()->det_F(1, at(moved, still)), F.determinant(), 1e-13);
}

TEST_F(Bricks, ExertForcesThatAreTheSlopeOfTheEnergy) {
  const NodalVector still = NodalVector::Zero(3, kNumNodes);
  NodalVector f = NodalVector::Zero(3, kNumNodes);
  term()->add_force(at(x, still), f);
  const double h = 1e-5;
  const NodalVector ahead = x + h * v, behind = x - h * v;
  const double slope = (term()->energy(at(ahead, still)) - term()->energy(at(behind, still))) / (2 * h);
  EXPECT_NEAR(-f.cwiseProduct(v).sum(), slope, 1e-7 * std::abs(slope));
  EXPECT_LE(f.rowwise().sum().norm(), 1e-13 * f.norm());
}

TEST_F(Bricks, LoseThePowerOfTheirDampingForces) {
  const NodalVector still = NodalVector::Zero(3, kNumNodes);
  NodalVector moving = still, resting = still;
  term()->add_force(at(x, v), moving);
  term()->add_force(at(x, still), resting);
  const double power = (resting - moving).cwiseProduct(v).sum();
  EXPECT_NEAR(term()->dissipation(at(x, v)), power, 1e-12 * power);
}

TEST_F(Bricks, HaveTheDerivativesOfTheForceAsStiffnessAndDamping) {
  std::vector<double> K(pattern.pattern().row.size(), 0), D = K;
  const NodalVector still = NodalVector::Zero(3, kNumNodes);
  term()->add_tangent(at(x, still), TangentKind::exact, K.data(), D.data());
  const double h = 1e-5;
  const auto slope = [&](const NodalVector& dx, const NodalVector& dv) {
    NodalVector ahead = NodalVector::Zero(3, kNumNodes), behind = ahead;
    const NodalVector x1 = x + h * dx, x0 = x - h * dx, v1 = h * dv, v0 = -h * dv;
    term()->add_force(at(x1, v1), ahead);
    term()->add_force(at(x0, v0), behind);
    return Vector(((behind - ahead) / (2 * h)).reshaped());
  };
  const Vector Kv = full(K) * Vector(v.reshaped()), Dv = full(D) * Vector(v.reshaped());
  EXPECT_LE((Kv - slope(v, still)).norm(), 1e-7 * Kv.norm());
  EXPECT_LE((Dv - slope(still, v)).norm(), 1e-7 * Dv.norm());
}

TEST_F(Bricks, AreBoundedInFrequency) {
  std::vector<double> K(pattern.pattern().row.size(), 0);
  const NodalVector still = NodalVector::Zero(3, kNumNodes);
  const auto bricks = term({.kinematics = Kinematics::linear});
  bricks->add_tangent(at(rest, still), TangentKind::exact, K.data(), nullptr);
  const Mass lumped(MassKind::lumped, mesh, {kDensity, kDensity}, dofs, pattern);
  const Mass consistent(MassKind::consistent, mesh, {kDensity, kDensity}, dofs, pattern);
  const double bound = bricks->max_frequency_squared(kDensity);
  for (const Mass* mass : {&lumped, &consistent}) {
    const double largest =
        Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(full(K), matrix_of(*mass)).eigenvalues().maxCoeff();
    EXPECT_LE(largest, mass->frequency_excess() * bound);
    EXPECT_GE(largest, 0.1 * bound);
  }
}

}  // namespace
}  // namespace orthodyn::second_element_test
