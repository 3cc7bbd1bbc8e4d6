// lib/fem with hexahedra of 8 and of 20 nodes.
#include <gtest/gtest.h>

#include "lib/element/corotational_law.h"
#include "lib/element/hex8.h"
#include "lib/fem/element_type.h"
#include "lib/fem/mass.h"
#include "lib/fem/terms/elastic_term.h"
#include "lib/mesh/quadratic.h"
#include "tests/element/states.h"

namespace orthodyn::hexahedra_test {
namespace {

constexpr double kDensity = 3, kBeta = 0.2;
const Vec3 kSize(2, 0.5, 1);

// Two bricks in a row, sheared.
Mesh two_bricks() {
  Mesh mesh;
  const Mat3 shear = (Mat3() << 1, 0.3, 0, 0, 1, 0.2, 0, 0, 1).finished();
  for (int layer = 0; layer < 3; ++layer)
    for (int a = 0; a < 4; ++a) {
      const Vec3 corner = (Vec3::Ones() + Hex8::nodes().col(a)) / 2;
      mesh.nodes.push_back(shear * kSize.cwiseProduct(Vec3(corner[0], corner[1], 0.5 * layer)));
    }
  mesh.cells = Cells(CellShape::hex8, std::vector{0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8, 9, 10, 11});
  return mesh;
}

Eigen::MatrixXd full(const BlockPattern& pattern, const std::vector<double>& values) {
  return Eigen::MatrixXd(Eigen::MatrixXd(pattern.pattern().matrix(values.data())).selfadjointView<Eigen::Lower>());
}

// Free bricks of 8 nodes.
class Bricks : public testing::Test {
 protected:
  Bricks() {
    for (int i = 0; i < x.cols(); ++i) rest.col(i) = bricks.node(i);
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
  Eigen::MatrixXd full(const std::vector<double>& values) const { return hexahedra_test::full(pattern, values); }
  // The sum of the elements' matrices.
  Eigen::MatrixXd mass_matrix(MassKind kind) const {
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(3 * kNumNodes, 3 * kNumNodes);
    for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
      const auto nodes = mesh.cells[e];
      const auto X = mesh.positions(e);
      const Eigen::MatrixXd one = kind == MassKind::lumped ? Eigen::MatrixXd(type.lumped_mass(X, kDensity).asDiagonal())
                                                           : type.consistent_mass(X, kDensity);
      for (Eigen::Index a = 0; a < one.rows(); ++a)
        for (Eigen::Index b = 0; b < one.cols(); ++b)
          M.block<3, 3>(3 * nodes[static_cast<std::size_t>(a)], 3 * nodes[static_cast<std::size_t>(b)]) +=
              one(a, b) * Mat3::Identity();
    }
    return M;
  }

  static constexpr int kNumNodes = 12;
  const ElementType& type = linear_hexahedron();
  Mesh bricks = two_bricks();
  ElementMesh mesh{bricks};
  DofMap dofs{kNumNodes, std::vector<bool>(3 * kNumNodes, false)};
  Random random{301};
  Mat3 random_axes = random.rotation();
  NodalVector rest{3, kNumNodes}, x{3, kNumNodes}, v{3, kNumNodes};
  BlockPattern pattern{bricks.cells, dofs, true};
};

// The x components are the places along z.
Vector linear_field(const std::vector<Vec3>& nodes) {
  Vector z = Vector::Zero(static_cast<Eigen::Index>(3 * nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) z[static_cast<Eigen::Index>(3 * i)] = nodes[i][2];
  return z;
}
// The integral of z^2 over the box, times the density.
const double kMassOfLinearField = kDensity * kSize.prod() * kSize[2] * kSize[2] / 3;

TEST_F(Bricks, HaveTheirMass) {
  for (const auto kind : {MassKind::lumped, MassKind::consistent})
    EXPECT_NEAR(mass_matrix(kind).sum(), 3 * kDensity * kSize.prod(), 1e-13 * kDensity);
}

// Rates linear in space are represented exactly.
TEST_F(Bricks, HaveTheConsistentMassOfLinearFields) {
  const Vector z = linear_field(bricks.nodes);
  EXPECT_NEAR(z.dot(mass_matrix(MassKind::consistent) * z), kMassOfLinearField, 1e-13);
}

// The same bricks with 20 nodes.
class QuadraticBricks : public testing::Test {
 protected:
  static Mesh make() {
    Mesh mesh = two_bricks();
    make_quadratic(mesh);
    return mesh;
  }

  Mesh bricks = make();
  ElementMesh mesh{bricks};
  DofMap dofs{static_cast<int>(bricks.nodes.size()), std::vector<bool>(3 * bricks.nodes.size(), false)};
  BlockPattern pattern{bricks.cells, dofs, true};
};

TEST_F(QuadraticBricks, HaveTheirMass) {
  for (const auto kind : {MassKind::lumped, MassKind::consistent}) {
    const Mass mass(kind, mesh, {{kDensity, kDensity}}, dofs, pattern);
    EXPECT_NEAR(mass.total(), kDensity * kSize.prod(), 64 * kEps * kDensity);
    std::vector<double> values(pattern.pattern().row.size(), 0);
    mass.add_to(1, values.data());
    EXPECT_NEAR(full(pattern, values).sum(), 3 * kDensity * kSize.prod(), 1e-13 * kDensity);
    const double excess = kind == MassKind::lumped ? 1 : element_type(CellShape::hex20).lumped_to_consistent();
    EXPECT_EQ(mass.frequency_excess(), excess);
  }
}

TEST_F(QuadraticBricks, HaveTheConsistentMassOfLinearFields) {
  const Mass mass(MassKind::consistent, mesh, {{kDensity, kDensity}}, dofs, pattern);
  const Vector z = linear_field(bricks.nodes);
  Vector Mz(z.size());
  mass.multiply(z, Mz);
  EXPECT_NEAR(z.dot(Mz), kMassOfLinearField, 1e-13);
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
  const auto elastic = term({.kinematics = Kinematics::linear});
  elastic->add_tangent(at(rest, still), TangentKind::exact, K.data(), nullptr);
  const double bound = elastic->max_frequency_squared(kDensity);
  for (const auto kind : {MassKind::lumped, MassKind::consistent}) {
    const double largest =
        Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(full(K), mass_matrix(kind)).eigenvalues().maxCoeff();
    EXPECT_LE(largest, (kind == MassKind::lumped ? 1 : type.lumped_to_consistent()) * bound);
    EXPECT_GE(largest, 0.1 * bound);
  }
}

}  // namespace
}  // namespace orthodyn::hexahedra_test
