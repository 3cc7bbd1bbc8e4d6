// Material axes per element: the same as one rotation if all agree, and the analytical solution of a tube with
// circumferential grain.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <numbers>

#include "lib/fem/element_mesh.h"
#include "lib/fem/terms/elastic_term.h"
#include "lib/material_axes/axes_source.h"
#include "lib/mesh/box.h"
#include "lib/mesh/quadratic.h"
#include "lib/mesh/selection.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::grain_test {
namespace {

TEST(ElementAxes, AreTheRotationsTheyWereMadeFrom) {
  Random random(201);
  for (const int points : {1, 4}) {
    const int size = 2 * Batch::kLanes + 1;
    std::vector<Mat3> each;
    for (int k = 0; k < points * size; ++k) each.push_back(random.rotation());
    each[1] = Vec3(-1, -1, 1).asDiagonal();  // half turns, whose quaternion has no real part
    each[2] = Vec3(1, -1, -1).asDiagonal();
    const ElementAxes axes(each, points);
    EXPECT_FALSE(axes.uniform());
    for (int k = 0; k < size; ++k)
      for (int p = 0; p < points; ++p) {
        const Mat3 Q = axes.of(k, p);
        EXPECT_LE((Q - each[static_cast<std::size_t>(points * k + p)]).cwiseAbs().maxCoeff(), 16 * kEps);
        EXPECT_LE((Q.transpose() * Q - Mat3::Identity()).cwiseAbs().maxCoeff(), 16 * kEps);
        const Mat3T<Batch> packed = axes.batch(k / Batch::kLanes, p);
        for (int i = 0; i < 9; ++i) EXPECT_NEAR(packed(i)[k % Batch::kLanes], Q(i), 2 * kEps);
      }
  }
}

TEST(ElementAxes, HaveTheMeanOfTheirPoints) {
  const auto turned = [](double angle) { return Mat3(Eigen::AngleAxisd(angle, Vec3(1, 2, 2) / 3)); };
  const ElementAxes axes({turned(0.1), turned(0.3), turned(0.4), turned(0.6)}, 4);
  EXPECT_LE((axes.mean(0) - turned(0.35)).norm(), 64 * kEps);
}

// Axes that vary within an element are evaluated at the integration points.
TEST(ElementAxes, OfQuadraticElementsAreThoseAtTheirPoints) {
  Mesh mesh = make_box({.size = {2, 1, 1}, .cells = {1, 1, 1}});
  make_quadratic(mesh);
  const auto source = Registry<AxesSource>::read(
      Config::from_text("axes: {type: cylindrical, point: [5, 5, 0], axis: [0, 0, 1]}", "a.yaml").at("axes"));
  Warnings notes;
  const AxesField field = source->field(mesh, notes);
  const ElementMesh elements(mesh);
  const ElementAxes axes = element_axes(*source, field, quadratic_tetrahedron(), elements, {0, 1, 2, 3, 4});
  for (int k = 0; k < 5; ++k) {
    const auto points = quadratic_tetrahedron().points(elements.positions(static_cast<std::size_t>(k)));
    ASSERT_EQ(points.cols(), 4);
    for (int p = 0; p < 4; ++p) EXPECT_LE((axes.of(k, p) - field(points.col(p), k)).norm(), 16 * kEps);
  }
}

TEST(ElementAxes, OfOneRotationTakeNoMemory) {
  EXPECT_EQ(ElementAxes(Mat3(Mat3::Identity())).bytes(), 0u);
  EXPECT_LE(ElementAxes(std::vector<Mat3>(64, Mat3::Identity())).bytes(), 64u * 32);
}

BuiltTestScene body(const Mesh& mesh, const std::string& axes, const std::string& more = "") {
  given_mesh() = mesh;
  return BuiltTestScene(fmt::format(R"(
mesh: {{type: given}}
materials: {{m: {}}}
regions: {{body: {{material: m, axes: {}}}}}
damping: {{stiffness: 0.1}}
time: {{end: 1}}
{}
)",
                                    fibre_material(10), axes, more));
}

const Mesh kBlock = make_box({.size = {2, 1, 1}, .cells = {2, 2, 1}});

class Grain : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Laws, Grain,
                         testing::Values("elasticity: {corotation: exact}", "elasticity: {kinematics: linear}",
                                         "elasticity: {corotation: warped, warped_tangent: unsymmetric}"));

class TurningGrain : public Grain {};
INSTANTIATE_TEST_SUITE_P(Laws, TurningGrain,
                         testing::Values("elasticity: {corotation: exact}",
                                         "elasticity: {corotation: warped, warped_tangent: unsymmetric}"));

// One rotation against the same for each element.
TEST_P(Grain, OfEqualAxesInAllElementsIsThatOfOneRotation) {
  Random random(202);
  const auto s = body(kBlock, "{}", GetParam());
  const auto& parts = s.model().parts();
  const Mat3 Q = random.rotation();
  std::vector<int> cells(kBlock.cells.size());
  for (std::size_t k = 0; k < cells.size(); ++k) cells[k] = static_cast<int>(k);
  const auto term = [&](const ElementAxes& axes) {
    return linear_tetrahedron().elastic_term(
        ElementMesh(kBlock), {"body", cells, s.scene.materials[0].second->stiffness(), axes, 0.3, s.scene.elasticity},
        *parts.pattern);
  };
  const auto one = term(Q), each = term(ElementAxes(std::vector<Mat3>(cells.size(), Q)));
  for (const double amplitude : {0.1, 1.0}) {  // at 1 some elements are inverted and treated one by one
    const NodalExpansion nodal(parts, 0, random_dofs(random, s.size(), amplitude), random_dofs(random, s.size(), 1));
    const NodalState state = nodal.state();
    NodalVector f_one = NodalVector::Zero(3, nodal.x.cols()), f_each = f_one;
    one->add_force(state, f_one);
    each->add_force(state, f_each);
    EXPECT_LE((f_one - f_each).norm(), 1e-12 * f_one.norm());
    EXPECT_NEAR(one->energy(state), each->energy(state), 1e-12 * one->energy(state));
    EXPECT_NEAR(one->dissipation(state), each->dissipation(state), 1e-12 * one->dissipation(state));
    EXPECT_NEAR(one->max_frequency_squared(1), each->max_frequency_squared(1), 1e-12 * one->max_frequency_squared(1));
    const auto n = parts.pattern->pattern().row.size();
    std::vector<double> K_one(n), K_each(n), D_one(n), D_each(n);
    one->add_tangent(state, TangentKind::exact, K_one.data(), D_one.data());
    each->add_tangent(state, TangentKind::exact, K_each.data(), D_each.data());
    const auto difference = [n](const std::vector<double>& a, const std::vector<double>& b) {
      const auto size = static_cast<Eigen::Index>(n);
      return (Eigen::Map<const Vector>(a.data(), size) - Eigen::Map<const Vector>(b.data(), size)).norm() /
             Eigen::Map<const Vector>(a.data(), size).norm();
    };
    EXPECT_LE(difference(K_one, K_each), 1e-12);
    EXPECT_LE(difference(D_one, D_each), 1e-12);
  }
}

// At a distance d the circumferential direction rotates by about 1/d over the block.
TEST_P(Grain, FarFromTheAxisOfACylinderIsThatOfStraightAxes) {
  Random random(203);
  const auto straight = body(kBlock, "{first: [0, 1, 0], second: [0, 0, 1]}", GetParam());
  const Vector q = random_dofs(random, straight.size(), 0.1), v = random_dofs(random, straight.size(), 0.1);
  const Vector f = straight.force(q, v);
  const auto error = [&](double d) {
    const auto s = body(kBlock, fmt::format("{{type: cylindrical, point: [{}, 0, 0], order: TLR}}", -d), GetParam());
    return (s.force(q, v) - f).norm() / f.norm();
  };
  const double near = error(1e3), far = error(1e5);
  EXPECT_LE(near, 5e-3);
  EXPECT_NEAR(near / far, 100, 10);
}

TEST_P(TurningGrain, TurnsAndMovesWithTheWholeProblem) {
  Random random(204);
  const Mat3 R = random.rotation();
  const Vec3 shift = random.vector(), point(0.3, 0.2, 0.1), axis(0.2, 0.3, 1);
  Mesh turned = kBlock;
  for (Vec3& X : turned.nodes) X = R * X + shift;
  const auto text = [](const Vec3& p, const Vec3& a) {
    return fmt::format("{{type: cylindrical, point: {}, axis: {}, spiral: 0.3 rad}}", Value<Vec3>::yaml(p),
                       Value<Vec3>::yaml(a));
  };
  const auto here = body(kBlock, text(point, axis), GetParam());
  const auto there = body(turned, text(R * point + shift, R * axis), GetParam());
  for (const double amplitude : {0.1, 0.6}) {
    const Vector q = random_dofs(random, here.size(), amplitude);
    const NodalVector u = R * here.nodal(q), expected = R * here.nodal(here.force(q));
    const Vector turned_q = u.reshaped();
    EXPECT_LE((there.nodal(there.force(turned_q)) - expected).norm(), 1e-12 * expected.norm());
    EXPECT_NEAR(there.potential(turned_q), here.potential(q), 1e-12 * here.potential(q));
  }
}

TEST(GrainField, IsObservedInEachElement) {
  const auto s = body(kBlock, "{type: cylindrical, point: [1, 0.5, 0]}");
  const auto radial = s.model().evaluate("material_axis_2", {0, s.zero(), s.zero()});
  for (std::size_t e = 0; e < kBlock.cells.size(); ++e) {
    const Vec3 c = centroid(kBlock, static_cast<int>(e));
    const Vec3 expected = Vec3(c[0] - 1, c[1] - 0.5, 0).normalized();
    EXPECT_LE((Eigen::Map<const Vec3>(&radial[3 * e]) - expected).norm(), 1e-12);
  }
}

// A quarter of a thick tube, inner radius 1, outer 2, held in plane strain and by its symmetry, under an
// inner pressure of 1. In cylindrical axes (R, T, L) the radial displacement solves
//     C_RR (u'' + u'/r) = C_TT u / r^2,  so  u = A r^k + B r^-k,  k = sqrt(C_TT / C_RR)
// (Lekhnitskii, Theory of elasticity of an anisotropic body, section 16), with C_RR u' + C_RT u/r = -1 at
// r = 1 and 0 at r = 2.
class Tube {
 public:
  explicit Tube(int cells) : scene_(make(cells)) {
    const auto& mesh = scene_.mesh();
    NodalVector load = NodalVector::Zero(3, static_cast<Eigen::Index>(mesh.nodes.size()));
    for (const FaceCorners& t : mesh.surfaces.at("x0")) {
      const auto at = [&](std::size_t k) { return mesh.nodes[static_cast<std::size_t>(t[k])]; };
      const Vec3 outward_area = 0.5 * (at(1) - at(0)).cross(at(2) - at(0));
      for (const int node : t) load.col(node) -= outward_area / 3;
    }
    Vector f(scene_.size());
    scene_.model().parts().dofs->restrict_to(load, f);
    const Eigen::SparseMatrix<double> K = scene_.stiffness(scene_.zero()).sparseView();
    u_ = scene_.nodal(Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(K).solve(f));
  }

  // Largest error of the displacement relative to its largest value.
  double error() const {
    double worst = 0;
    for (std::size_t i = 0; i < scene_.mesh().nodes.size(); ++i) {
      const Vec3 X = scene_.mesh().nodes[i];
      const double r = std::hypot(X[0], X[1]);
      const Vec3 expected = exact(r) / r * Vec3(X[0], X[1], 0);
      worst = std::max(worst, (u_.col(static_cast<Eigen::Index>(i)) - expected).norm());
    }
    return worst / exact(1);
  }

  // u is made of r^k and r^-k.
  static double exponent() {
    const auto C = stiffness(constants());
    return std::sqrt(C.c22 / C.c11);  // 1 = R, 2 = T
  }

  static double exact(double r) {
    const auto C = stiffness(constants());
    const double k = exponent();
    const auto stress = [&](double m, double at) { return (C.c11 * m + C.c12) * std::pow(at, m - 1); };
    const Eigen::Matrix2d system =
        (Eigen::Matrix2d() << stress(k, 1), stress(-k, 1), stress(k, 2), stress(-k, 2)).finished();
    const Eigen::Vector2d ab = system.inverse() * Eigen::Vector2d(-1, 0);
    return ab[0] * std::pow(r, k) + ab[1] * std::pow(r, -k);
  }

 private:
  static OrthotropicConstants constants() { return stable_family({1, 16, 2}, 0.3); }

  static BuiltTestScene make(int cells) {
    Mesh mesh = make_box({.size = {1, 1, 0.25}, .cells = {cells, cells, 1}});
    for (Vec3& X : mesh.nodes) {
      const double r = 1 + X[0], angle = X[1] * std::numbers::pi / 2;
      X = {r * std::cos(angle), r * std::sin(angle), X[2]};
    }
    given_mesh() = mesh;
    return BuiltTestScene(R"(
mesh: {type: given}
materials: {m: {type: orthotropic_stable, density: 1, young: [1, 16, 2], nu: 0.3}}
regions: {body: {material: m, axes: {type: cylindrical, order: RTL}}}
elasticity: {kinematics: linear}
clamps: [{surface: y0, components: [y]}, {surface: y1, components: [x]}, {surface: z0, components: [z]}, {surface: z1, components: [z]}]
time: {end: 1}
)");
  }

  BuiltTestScene scene_;
  NodalVector u_;
};

TEST(HoopReinforcedTube, UnderInnerPressureWidensAsKnownAndTheErrorIsOfSecondOrder) {
  const double coarse = Tube(4).error(), fine = Tube(8).error();
  // Twice the interpolation error of u ~ r^-k by linear cells of h = 1/8: h^2/8 max u''.
  const double k = Tube::exponent();
  EXPECT_LE(fine, 2 * k * (k + 1) / (8 * 8 * 8));
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.5) << coarse << " " << fine;
}

}  // namespace
}  // namespace orthodyn::grain_test
