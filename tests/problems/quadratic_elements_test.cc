// Quadratic tetrahedra: patch tests, orders in space, a beam, and conservation laws.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <numbers>

#include "lib/analysis/modes.h"
#include "lib/core/symmetric_eigen.h"
#include "lib/element/tet10.h"
#include "lib/mesh/box.h"
#include "lib/mesh/quadratic.h"
#include "lib/study/converge/richardson.h"
#include "tests/problems/running.h"

namespace orthodyn::quadratic_elements_test {
namespace {

const std::string kWood =
    "{type: orthotropic, density: 1, young: [10, 1, 0.5], nu12: 0.4, nu23: 0.4, nu31: 0.02, g12: 0.7, g23: 0.1, g13: "
    "0.6}";

const std::string kIsotropic = "{type: isotropic, density: 1, young: 1, nu: 0.3}";

// A free box with oblique material axes at small strain; `distorted` shifts the inner nodes.
BuiltTestScene box(int cells, int order, bool distorted = false, const std::string& material = kWood) {
  Mesh mesh = make_box({.cells = {cells, cells, cells}, .split = BoxMesh::Split::six});
  Random random(501);
  if (distorted)
    for (Vec3& x : mesh.nodes)
      if ((x.array() > 0.01).all() && (x.array() < 0.99).all()) x += 0.15 / cells * random.vector();
  if (order == 2) make_quadratic(mesh);
  given_mesh() = mesh;
  return BuiltTestScene(fmt::format(R"(
mesh: {{type: given}}
materials: {{m: {}}}
regions: {{body: {{material: m, axes: {}}}}}
elasticity: {{kinematics: linear}}
mass: consistent
time: {{end: 1}}
)",
                                    material, kTurnedAxes));
}

bool is_inner(const Vec3& x) { return (x.array() > 1e-9).all() && (x.array() < 1 - 1e-9).all(); }

// Stress of a displacement gradient, Pa, from the nodal forces of one free tetrahedron with the scene's material.
class Law {
 public:
  explicit Law(const std::string& material = kWood) : one_(one_tet(material)) {}
  Mat3 stress(const Mat3& gradient) const {
    NodalVector u(3, 4);
    for (Eigen::Index a = 0; a < 4; ++a) u.col(a) = gradient * Vec3(one_.model().parts().rest->col(a));
    Vector q(12);
    one_.model().parts().dofs->restrict_to(u, q);
    const NodalVector f = one_.nodal(one_.force(q));
    return -6 * f.rightCols<3>();  // nodes 1, 2, 3 of the unit tet: f_a = -V P grad N_a
  }

 private:
  static BuiltTestScene one_tet(const std::string& material) {
    Mesh mesh;
    mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.cells = Cells(std::vector<Tet>{{0, 1, 2, 3}});
    mesh.region_of = {0};
    mesh.region_names = {"body"};
    given_mesh() = mesh;
    return BuiltTestScene(fmt::format(R"(
mesh: {{type: given}}
materials: {{m: {}}}
regions: {{body: {{material: m, axes: {}}}}}
elasticity: {{kinematics: linear}}
time: {{end: 1}}
)",
                                      material, kTurnedAxes));
  }
  BuiltTestScene one_;
};

// u_i = a_i + A_ij x_j + x . B_i x / 2 needs the uniform body force b = -div stress, which balances the force at every
// inner node.
TEST(PatchTest, OfAQuadraticDisplacementIsPassedByQuadraticElements) {
  Random random(502);
  const Mat3 A = random.matrix();
  Mat3 B[3];
  for (Mat3& b : B) {
    b = random.matrix();
    b = (b + b.transpose()).eval();
  }
  const auto u = [&](const Vec3& x) {
    Vec3 out = A * x;
    for (int i = 0; i < 3; ++i) out[i] += 0.5 * x.dot(B[i] * x);
    return out;
  };
  const Law law;
  Vec3 divergence = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    Mat3 change;  // of grad u with x_k
    for (int i = 0; i < 3; ++i) change.row(i) = B[i].col(k).transpose();
    divergence += law.stress(change).col(k);
  }
  const auto residual = [&](int order) {
    const BuiltTestScene s = box(3, order, true);
    const NodalVector f = s.nodal(s.force(s.dofs(u)));
    const Vector& weights = s.model().parts().mass->row_sums();  // density 1
    double largest = 0;
    for (Eigen::Index n = 0; n < f.cols(); ++n)
      if (is_inner(s.model().parts().rest->col(n)))
        largest = std::max(largest, (f.col(n) - weights[n] * divergence).norm());
    return largest / divergence.norm();
  };
  EXPECT_LE(residual(2), 1e-13);
  EXPECT_GE(residual(1), 1e-3);
}

TEST(PatchTest, OfALinearDisplacementIsPassedByBoth) {
  Random random(503);
  const Mat3 A = random.matrix();
  for (const int order : {1, 2}) {
    const BuiltTestScene s = box(3, order, true);
    const NodalVector f = s.nodal(s.force(s.dofs([&](const Vec3& x) { return Vec3(A * x); })));
    for (Eigen::Index n = 0; n < f.cols(); ++n)
      if (is_inner(s.model().parts().rest->col(n))) {
        EXPECT_LE(f.col(n).norm(), 1e-14);
      }
  }
}

// Shape functions and their gradients at barycentric coordinates, by the order of the mesh.
Vector shape(int order, const Eigen::Vector4d& L) {
  if (order == 1) return L;
  return Tet10::shape(L);
}
Eigen::MatrixXd slopes(int order, const Eigen::Vector4d& L) {
  if (order == 2) return Tet10::shape_slopes(L);
  Eigen::MatrixXd by_L(4, 3);
  by_L << -1, -1, -1, Mat3::Identity();
  return by_L;
}

struct SpaceError {
  double displacement, gradient;  // L2 norms
  double energy, estimated;       // J, elastic energy of the error
};

// The error of a manufactured solution u = sin(2 x_1 + x_2) w + cos(x_2 - 2 x_3) z with its body force and boundary
// values.
SpaceError manufactured(int cells, int order, const std::string& material) {
  const Vec3 w(1, -0.5, 0.3), z(0.2, 0.7, -1), k(2, 1, 0), l(0, 1, -2);
  const auto u = [&](const Vec3& x) { return Vec3(std::sin(k.dot(x)) * w + std::cos(l.dot(x)) * z); };
  const auto gradient = [&](const Vec3& x) {
    return Mat3(std::cos(k.dot(x)) * w * k.transpose() - std::sin(l.dot(x)) * z * l.transpose());
  };
  const Law law(material);
  const Vec3 along_k = law.stress(w * k.transpose()) * k, along_l = law.stress(z * l.transpose()) * l;
  const auto body_force = [&](const Vec3& x) {
    return Vec3(std::sin(k.dot(x)) * along_k + std::cos(l.dot(x)) * along_l);
  };

  const BuiltTestScene s = box(cells, order, false, material);
  const ElementMesh elements(s.mesh());
  const auto each_point = [&](const auto& visit) {
    for (std::size_t c = 0; c < elements.cells.size(); ++c) {
      const auto X = elements.positions(c);
      for (const auto& [L, weight] : tetrahedron_points_of_degree_7()) {
        const Mat3 J = X * slopes(order, L);
        visit(elements.cells[c], shape(order, L), Eigen::MatrixXd(slopes(order, L) * J.inverse()),
              Vec3(X * shape(order, L)), weight * J.determinant());
      }
    }
  };
  NodalVector load = NodalVector::Zero(3, s.model().parts().rest->cols());
  each_point([&](auto nodes, const Vector& N, const Eigen::MatrixXd&, const Vec3& x, double volume) {
    const Vec3 b = volume * body_force(x);
    for (std::size_t a = 0; a < nodes.size(); ++a) load.col(nodes[a]) += N[static_cast<Eigen::Index>(a)] * b;
  });

  // K u = f at the free coordinates, with u given on the surface.
  Linearization at;
  s.model().linearize(0, s.zero(), s.zero(), TangentKind::exact, at);
  const Eigen::SparseMatrix<double> lower = s.model().pattern().matrix(at.stiffness.data());
  Eigen::SparseMatrix<double> K = lower.selfadjointView<Eigen::Lower>();
  Vector q = s.dofs(u), f(s.size());
  s.model().parts().dofs->restrict_to(load, f);
  const Vector held = s.dofs([&](const Vec3& x) { return Vec3(Vec3::Constant(is_inner(x) ? 0 : 1)); });
  q = q.cwiseProduct(held);
  f -= K * q;
  for (int j = 0; j < K.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(K, j); it; ++it)
      if (held[it.row()] + held[it.col()] > 0) it.valueRef() = it.row() == it.col() ? 1 : 0;
  f = f.cwiseProduct(Vector::Ones(f.size()) - held);
  q += Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(K).solve(f);

  const NodalVector nodal = s.nodal(q);
  SpaceError error{0, 0, 0, s.model().evaluate("energy.mesh_error", {0, q, s.zero()})[0]};
  each_point([&](auto nodes, const Vector& N, const Eigen::MatrixXd& G, const Vec3& x, double volume) {
    Vec3 value = -u(x);
    Mat3 slope = -gradient(x);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const auto row = static_cast<Eigen::Index>(a);
      value += N[row] * nodal.col(nodes[a]);
      slope += nodal.col(nodes[a]) * G.row(row);
    }
    error.displacement += volume * value.squaredNorm();
    error.gradient += volume * slope.squaredNorm();
    error.energy += volume * 0.5 * law.stress(slope).cwiseProduct(slope).sum();
  });
  error.displacement = std::sqrt(error.displacement);
  error.gradient = std::sqrt(error.gradient);
  return error;
}

struct SpaceCase {
  int order;
  std::string material;
};

class Space : public testing::TestWithParam<SpaceCase> {};
INSTANTIATE_TEST_SUITE_P(Order, Space,
                         testing::Values(SpaceCase{1, kWood}, SpaceCase{2, kWood}, SpaceCase{1, kIsotropic},
                                         SpaceCase{2, kIsotropic}),
                         [](const auto& one) {
                           return fmt::format("{}_{}", one.param.order,
                                              one.param.material == kWood ? "wood" : "isotropic");
                         });

// The stress by its energy norm.
TEST_P(Space, ErrorsFallWithTheOrderOfTheElement) {
  const auto& [order, material] = GetParam();
  const int cells = order == 1 ? 6 : 3;
  const SpaceError coarse = manufactured(cells, order, material), fine = manufactured(2 * cells, order, material);
  EXPECT_NEAR(std::log2(coarse.displacement / fine.displacement), order + 1, 0.2);
  EXPECT_NEAR(std::log2(coarse.gradient / fine.gradient), order, 0.1);
  EXPECT_NEAR(std::log2(coarse.energy / fine.energy) / 2, order, 0.1);
}

// In the energy norm, on a smooth solution.
TEST_P(Space, ErrorsAreEstimatedByRecoveredStresses) {
  const auto& [order, material] = GetParam();
  for (const int cells : {2, 4, 7}) {
    const SpaceError error = manufactured(cells * (order == 1 ? 2 : 1), order, material);
    const double effectivity = std::sqrt(error.estimated / error.energy);
    EXPECT_GT(effectivity, 0.7) << cells;
    EXPECT_LT(effectivity, 1.5) << cells;
  }
}

// Without lateral contraction (nu = 0) the clamp causes no disturbance: Timoshenko's beam, shear factor 5/6.
TEST(QuadraticBeam, BendsAsTimoshenkosAndALinearOneTwoThirdsAsFar) {
  const auto bending = [](int order) {
    const BuiltTestScene s(fmt::format(R"(
mesh: {{type: box, size: [1, 0.1, 0.1], cells: [20, 2, 2], order: {}}}
materials: {{m: {{type: isotropic, density: 1, young: 1e9, nu: 0}}}}
elasticity: {{kinematics: linear}}
clamps: [{{surface: x0}}]
loads: [{{surface: x1, force: [0, 0, -1]}}]
time: {{end: 1}}
)",
                                       order));
    Linearization at;
    s.model().linearize(0, s.zero(), s.zero(), TangentKind::exact, at);
    const Eigen::SparseMatrix<double> K = s.model().pattern().matrix(at.stiffness.data());
    const Vector q = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(K).solve(s.force(s.zero()));
    return -s.nodal(q)(2, nearest_node(s.mesh(), {1, 0.05, 0.05}));
  };
  const double I = 1e-4 / 12, shear = 1 / (5.0 / 6 * 0.5e9 * 0.01), expected = 1 / (3 * 1e9 * I) + shear;
  EXPECT_NEAR(bending(2), expected, 5e-3 * expected);
  EXPECT_LT(bending(1), 0.7 * expected);
}

// A clamped spruce beam with grain along its axis, against Timoshenko's beam (kappa = 5/6; roots of its determinant),
// whose clamp does not restrain lateral contraction, and against the limit of three meshes.
TEST(QuadraticBeam, OfSpruceVibratesAsItsRefinedLimit) {
  const auto frequencies = [](int cells) {
    const BuiltTestScene s(fmt::format(R"(
mesh: {{type: box, size: [1, 0.05, 0.05], cells: [{}, {}, {}]}}
materials:
  m: {{type: orthotropic, density: 400, young: [10.8e9, 0.84e9, 0.46e9], nu12: 0.44, nu23: 0.44, nu31: 0.0225, g12: 0.69e9, g23: 0.032e9, g13: 0.66e9}}
elasticity: {{kinematics: linear}}
clamps: [{{surface: x0}}]
time: {{end: 1}}
)",
                                       10 * cells, cells, cells));
    const Modes found = natural_modes(s.model(), {0, s.zero(), s.zero()}, 2);
    return std::array{found.modes[0].frequency(), found.modes[1].frequency()};
  };
  const auto coarse = frequencies(1), middle = frequencies(2), fine = frequencies(4);
  const std::array timoshenko{41.5561, 41.5729};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto limit = study::converge::extrapolate({coarse[k], middle[k], fine[k]}, 2, 4);
    EXPECT_NEAR(middle[k], limit->limit, 3e-3 * limit->limit);
    EXPECT_NEAR(limit->limit, timoshenko[k], 5e-3 * timoshenko[k]);
  }
}

// A round body of curved elements under surface loads.
BuiltTestScene round(const std::string& more) {
  return BuiltTestScene(fmt::format(R"(
mesh: {{type: cylinder, radius: 0.5, length: 1, cells: [8, 1, 2], order: 2}}
materials: {{m: {{type: isotropic, density: 2, young: 1, nu: 0.3}}}}
time: {{end: 1}}
{}
)",
                                    more));
}

// Without gravity and at rest only the loads act.
Vec3 resultant(const NodalVector& f) { return f.rowwise().sum(); }
Vec3 moment(const BuiltTestScene& s, const NodalVector& f) {
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index n = 0; n < f.cols(); ++n) sum += Vec3(s.model().parts().rest->col(n)).cross(Vec3(f.col(n)));
  return sum;
}

TEST(QuadraticFaces, CarryTheResultantAndMomentOfATraction) {
  const auto s = round("loads: [{surface: end1, traction: [\"1 + x\", \"2*y\", 3]}]");
  const NodalVector f = s.nodal(s.force(s.zero()));
  // Over the disc of radius 1/2 at z = 1, area pi/4, to the accuracy of eight curved edges.
  // M = integral of (3 y - 2 y, (1 + x) - 3 x, 2 x y - (1 + x) y): all but the 1 is odd.
  const double area = std::numbers::pi / 4;
  EXPECT_LE((resultant(f) - Vec3(area, 0, 3 * area)).norm(), 3e-3);
  EXPECT_LE((moment(s, f) - Vec3(0, area, 0)).norm(), 3e-3);
}

TEST(QuadraticFaces, UnderPressureAllAroundHaveTheEnergyPV) {
  const auto s = round("terms: [{type: pressure, pressure: 0.7}]");
  const auto bare = round("");
  Random random(504);
  const Vector q = random_dofs(random, s.size(), 0.02), d = random_dofs(random, s.size(), 1);
  const NodalVector f = s.nodal(s.force(q) - bare.force(q));
  EXPECT_LE(resultant(f).norm(), 1e-13);
  // The work on d is -p dV, with V integrated over the elements, where det F is a polynomial along d.
  const auto volume = [&](double h) {
    const NodalVector x = s.positions(q + h * d);
    const ElementMesh elements(s.mesh());
    double sum = 0;
    for (std::size_t c = 0; c < elements.cells.size(); ++c) {
      ElementNodes<10> now;
      for (Eigen::Index a = 0; a < 10; ++a) now.col(a) = x.col(elements.cells[c][static_cast<std::size_t>(a)]);
      sum += Tet10::mass(now, 1);
    }
    return sum;
  };
  const double rate = (volume(-2e-3) - 8 * volume(-1e-3) + 8 * volume(1e-3) - volume(2e-3)) / 12e-3;  // exact: cubic
  const Vector push = s.force(q) - bare.force(q);
  EXPECT_NEAR(push.dot(d), -0.7 * rate, 1e-10);
  // The stiffness is the derivative of the force, and symmetric.
  const Vector difference =
      (s.force(q + 1e-3 * d) - bare.force(q + 1e-3 * d) - s.force(q - 1e-3 * d) + bare.force(q - 1e-3 * d)) /
      2e-3;  // exact: quadratic
  const Eigen::MatrixXd K = s.stiffness(q) - bare.stiffness(q);
  EXPECT_LE((difference + K * d).norm(), 1e-10 * difference.norm());
}

// A uniform pressure has no forces at corners of triangles; a corner that hits the ground alone feels a force.
TEST(QuadraticFaces, OfContactHaveForcesOfAPressureAndAtSingleNodes) {
  const auto s =
      round("terms: [{type: ground_contact, point: [0, 0, 0.1], stiffness: 10, onset: 1e-3, surface: end0}]");
  const auto bare = round("");
  const NodalVector f = s.nodal(s.force(s.zero()));
  EXPECT_NEAR(resultant(f)[2], 10 * (0.1 - 0.5e-3) * std::numbers::pi / 4, 2e-3);
  for (Eigen::Index n = 0; n < f.cols(); ++n)
    if (s.model().parts().rest->col(n)[2] == 0) {
      EXPECT_GT(f(2, n), -1e-12);
      const Vector q = s.dofs(
          [&](const Vec3& x) { return x == s.mesh().node(static_cast<int>(n)) ? Vec3(0, 0, -0.3) : Vec3(0, 0, 0.2); });
      EXPECT_GT(s.nodal(s.force(q) - bare.force(q))(2, n), 0.01);
    }
}

TEST(QuadraticElements, FallFreelyWithoutStrainWithEitherMass) {
  for (const char* mass : {"lumped", "consistent"}) {
    const auto s = round(fmt::format("gravity: [1, -2, 3]\nmass: {}", mass));
    Vector a = s.force(s.zero());
    s.model().solve_mass(a);
    const NodalVector nodal = s.nodal(a);
    for (Eigen::Index n = 0; n < nodal.cols(); ++n) EXPECT_LE((nodal.col(n) - Vec3(1, -2, 3)).norm(), 1e-11) << mass;
  }
}

// The largest frequency belongs to the whole mass and stiffness matrix, including curved elements.
TEST(QuadraticElements, AreNoFasterThanTheirBound) {
  const auto s = round("");
  const Eigen::MatrixXd K = s.stiffness(s.zero());
  const Vector root = s.mass().diagonal().cwiseSqrt();
  const Vector squares =
      symmetric_eigenvalues(Eigen::MatrixXd(root.asDiagonal().inverse() * K * root.asDiagonal().inverse()));
  const double fastest = std::sqrt(squares[squares.size() - 1]);
  EXPECT_LE(fastest, s.model().frequency_bound());
  EXPECT_GE(fastest, 0.3 * s.model().frequency_bound());
}

TEST(QuadraticElements, InFreeFlightKeepEnergyAndMomentum) {
  for (const double rtol : {1e-5, 1e-7}) {
    const BuiltTestScene s(fmt::format(R"(
mesh: {{type: cylinder, radius: 0.5, length: 1, cells: [8, 1, 1], order: 2}}
materials: {{m: {{type: orthotropic_stable, density: 1, young: [10, 1, 1], nu: 0.3}}}}
regions: {{body: {{material: m, axes: {}}}}}
initial: {{spin: [0.3, 0.2, 1], deformation_gradient: [[1.2, 0, 0], [0, 1, 0], [0, 0, 1]]}}
integrator: {{type: arkode_dirk, rtol: {}}}
time: {{end: 1.5}}
)",
                                       kTurnedAxes, rtol));
    double first = 0, worst = 0;
    Vec3 L = Vec3::Zero(), twist = Vec3::Zero();
    const auto outcome = run_scene(s, 20, [&](const State& state) {
      if (state.t == 0) {
        first = total_energy(s, state);
        L = momentum(s, "angular", state);
      }
      worst = std::max(worst, std::abs(total_energy(s, state) / first - 1));
      twist = twist.cwiseMax((momentum(s, "angular", state) - L).cwiseAbs());
    });
    EXPECT_EQ(outcome.status, Outcome::Status::completed) << outcome.message;
    EXPECT_LE(worst, 100 * rtol);
    EXPECT_LE(twist.norm(), 100 * rtol * L.norm());
  }
}

}  // namespace
}  // namespace orthodyn::quadratic_elements_test
