// Bodies that swell: free and held, with fields that vary in space and time.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "lib/fem/terms/added_term.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::swelling_test {
namespace {

const std::string kMaterial =
    "{type: orthotropic_stable, density: 1, young: [10, 1, 2], nu: 0.3, expansion: {moisture: [-0.02, 0.1, 0.3], "
    "temperature: [0.01, 0.02, 0.03]}}";

std::string block(const std::string& more, const std::string& mesh = "cells: [2, 2, 1]") {
  return fmt::format(R"(
mesh: {{type: box, size: [1, 0.8, 0.6], {}}}
materials: {{m: {}}}
regions: {{all: {{material: m, axes: {}}}}}
time: {{end: 2}}
{}
)",
                     mesh, kMaterial, kTurnedAxes, more);
}

// The displacement of a body that swells freely by a strain in material axes, turned by R.
Vector swollen(const BuiltTestScene& s, const Vec3& strain, const Mat3& R) {
  const Mat3 Q = s.model().parts().elastic.front()->axes_at_rest(0, 0);
  const Mat3 F = R * (Mat3::Identity() + Q * strain.asDiagonal() * Q.transpose());
  return s.dofs([&](const Vec3& X) { return Vec3(F * X - X); });
}

class FreeSwelling : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Meshes, FreeSwelling,
                         testing::Values("cells: [2, 2, 1], order: 1", "cells: [2, 2, 1], order: 2",
                                         "cells: [2, 2, 1], elements: hexahedra, order: 1",
                                         "cells: [2, 2, 1], elements: hexahedra, order: 2",
                                         "cells: [2, 2, 1], elements: wedges, order: 1",
                                         "cells: [2, 2, 1], elements: wedges, order: 2"));

TEST_P(FreeSwelling, HasNoForceNoStressAndNoEnergy) {
  const BuiltTestScene s(block("moisture: {change: 0.8}\ntemperature: {change: -2}", GetParam()));
  const Vec3 strain = 0.8 * Vec3(-0.02, 0.1, 0.3) - 2 * Vec3(0.01, 0.02, 0.03);
  const Mat3 R = Eigen::AngleAxisd(2, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Vector q = swollen(s, strain, R);
  const double scale = s.force(s.zero()).norm();
  EXPECT_GE(scale, 0.01);
  EXPECT_LE(s.force(q).norm(), 1e-13 * scale);
  EXPECT_NEAR(s.scalar("energy.elastic", q, s.zero()), 0, 1e-14);
  for (const char* field : {"stress", "nodal_stress"})
    for (const double x : s.model().evaluate(field, {0, q, s.zero()})) EXPECT_NEAR(x, 0, 1e-12) << field;
  for (const double x : s.model().evaluate("strain", {0, q, s.zero()})) EXPECT_LE(std::abs(x), 0.3);
}

TEST(HeldSwelling, HasTheStressAndEnergyOfThePreventedStrain) {
  const BuiltTestScene s(block("moisture: {change: 0.5}"));
  const ElasticTerm& term = *s.model().parts().elastic.front();
  const Vec6 strain = (Vec6() << 0.5 * Vec3(-0.02, 0.1, 0.3), Vec3::Zero()).finished();
  const NodalVector zero = NodalVector::Zero(3, s.model().parts().rest->cols());
  const Eigen::Matrix<double, 6, Eigen::Dynamic> stresses = term.stresses({0, *s.model().parts().rest, zero, zero});
  const Vec6 expected = -term.stiffness() * strain;
  for (Eigen::Index i = 0; i < stresses.cols(); ++i)
    EXPECT_LE((stresses.col(i) - expected).norm(), 1e-15 * expected.norm());
  const double volume = 1 * 0.8 * 0.6;
  EXPECT_NEAR(s.scalar("energy.elastic", s.zero(), s.zero()), -0.5 * volume * expected.dot(strain), 1e-14);
}

// Half of the swelling at half of the load factor.
TEST(HeldSwelling, IsMultipliedByTheLoadFactorOfStatics) {
  const BuiltTestScene s(block("moisture: {change: 0.5}"));
  const State half{0, s.zero(), s.zero(), 0.5}, whole{0, s.zero(), s.zero(), 1};
  const auto at = [&](const char* name, const State& state) { return s.model().evaluate(name, state); };
  EXPECT_NEAR(at("energy.elastic", half)[0], 0.25 * at("energy.elastic", whole)[0], 1e-16);
  const auto a = at("stress", half), b = at("stress", whole);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], 0.5 * b[i], 1e-15);
}

TEST(SwellingInTime, PowerIsTheRateOfTheEnergyAtAFixedShape) {
  for (const char* moisture : {"{change: 0.5 + x*y, factor: {type: sine, frequency: 0.7 Hz}}",
                               "{formula: '0.5*exp(-t)*(1 + x) + sin(3*t)*z'}"})
    for (const char* kinematics : {"corotational", "linear"}) {
      const BuiltTestScene s(block(fmt::format("moisture: {}\nelasticity: {{kinematics: {}}}", moisture, kinematics)));
      Random random(311);
      const Vector q = random_dofs(random, s.size(), 0.05);
      const auto energy = [&](double t) { return s.model().evaluate("energy.elastic", {t, q, s.zero()})[0]; };
      const double power = s.model().evaluate("power.loads", {0.6, q, s.zero()})[0];
      const auto error = [&](double h) { return std::abs((energy(0.6 + h) - energy(0.6 - h)) / (2 * h) - power); };
      EXPECT_NEAR(error(2e-3) / error(1e-3), 4, 0.1) << moisture;
      EXPECT_LE(error(1e-3), 1e-4 * std::abs(power)) << moisture;
      EXPECT_TRUE(s.model().traits().loaded && s.model().traits().time_dependent);
      EXPECT_FALSE(s.model().traits().conservative);
    }
}

TEST(SwellingInSpace, NodalValuesAreInterpolatedByTheShapeFunctions) {
  for (const char* mesh : {"cells: [2, 2, 1], order: 1", "cells: [2, 2, 1], order: 2",
                           "cells: [2, 2, 1], elements: hexahedra, order: 2"}) {
    const BuiltTestScene formula(block("moisture: {change: 0.2 + 0.4*x - 0.3*y}", mesh));
    const std::string file = testing::TempDir() + "moisture.csv";
    std::ofstream out(file);
    out << "node,change\n";
    const auto& nodes = formula.mesh().nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      out << fmt::format("{},{:.17g}\n", i, 0.2 + 0.4 * nodes[i][0] - 0.3 * nodes[i][1]);
    out.close();
    const BuiltTestScene nodal(block(fmt::format("moisture: {{file: {}}}", file), mesh));
    const Vector f = formula.force(formula.zero());
    EXPECT_LE((nodal.force(nodal.zero()) - f).norm(), 1e-14 * f.norm()) << mesh;
  }
}

// A free isotropic body has no stress under a temperature that is linear in space: the strain a T I is compatible, and
// the body bends.
TEST(SwellingInSpace, ALinearTemperatureBendsAFreeBodyWithoutStress) {
  const double a = 1e-3, slope = 0.7;
  const BuiltTestScene s(fmt::format(R"(
mesh: {{type: box, size: [1, 0.8, 0.6], cells: [2, 2, 2], order: 2}}
materials: {{m: {{type: isotropic, density: 1, young: 3, nu: 0.3, expansion: {{temperature: {}}}}}}}
elasticity: {{kinematics: linear}}
temperature: {{change: {} * z}}
time: {{end: 1}}
)",
                                     a, slope));
  const Vector q = s.dofs([&](const Vec3& X) -> Vec3 {
    const double x = X[0], y = X[1], z = X[2];
    return a * slope * Vec3(x * z, y * z, 0.5 * (z * z - x * x - y * y));
  });
  EXPECT_LE(s.force(q).norm(), 1e-13 * s.force(s.zero()).norm());
}

TEST(SwellingInput, MistakesAreRefused) {
  const auto message = [](const std::string& more) -> std::string {
    try {
      const BuiltTestScene s(block(more));
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  };
  using testing::HasSubstr;
  EXPECT_THAT(message("moisture: {}"), HasSubstr("give one of change, formula and file; none is given"));
  EXPECT_THAT(message("moisture: {change: 1, formula: t}"), HasSubstr("the section has several"));
  EXPECT_THAT(message("moisture: {change: 1, kinks: [1]}"), HasSubstr("kinks"));
  EXPECT_THAT(message("moisture: {change: 1}\nelasticity: {corotation: warped}"), HasSubstr("warped"));
  EXPECT_THAT(message("moisture: {change: 1/0}"), HasSubstr("finite"));
  EXPECT_THAT(message("moisture: {change: 1, factor: {type: harmonic}}"), HasSubstr("is for loads"));
  const std::string file = testing::TempDir() + "few.csv";
  std::ofstream(file) << "node,change\n0,1\n";
  EXPECT_THAT(message(fmt::format("moisture: {{file: {}}}", file)), HasSubstr("has no value for node 1"));
  std::ofstream(file) << "node,change\n0,1\n0,2\n";
  EXPECT_THAT(message(fmt::format("moisture: {{file: {}}}", file)), HasSubstr("node 0 is given twice"));
}

// The values at the points of an element stay within those at its nodes, where quadratic functions would not.
TEST(SwellingInSpace, NodalValuesThatJumpDoNotOvershoot) {
  const std::string mesh = "cells: [2, 1, 1], elements: hexahedra, order: 2";
  const BuiltTestScene whole(block("moisture: {change: 1}", mesh));
  const std::string file = testing::TempDir() + "jump.csv";
  std::ofstream out(file);
  out << "node,change\n";
  const auto& nodes = whole.mesh().nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) out << fmt::format("{},{}\n", i, nodes[i][0] > 0.99 ? 1 : 0);
  out.close();
  const BuiltTestScene jump(block(fmt::format("moisture: {{file: {}}}", file), mesh));
  const auto stress_11 = [](const BuiltTestScene& s) {
    const NodalVector zero = NodalVector::Zero(3, s.model().parts().rest->cols());
    return Vector(s.model().parts().elastic.front()->stresses({0, *s.model().parts().rest, zero, zero}).row(0));
  };
  const double full = stress_11(whole)[0];  // negative where the material would expand along 1
  for (const double s : stress_11(jump)) {
    EXPECT_GE(s / full, -1e-14);
    EXPECT_LE(s / full, 1 + 1e-14);
  }
}

TEST(RubberInput, MistakesAreRefused) {
  const auto message = [](const std::string& more) -> std::string {
    try {
      const BuiltTestScene s("mesh: {type: box, size: [1, 1, 1], cells: [1, 1, 1]}\ntime: {end: 1}\n" + more);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  };
  using testing::HasSubstr;
  const std::string isotropic = "materials: {m: {type: isotropic, density: 1, young: 1, nu: 0.3}}\n";
  EXPECT_THAT(message("materials: {m: " + fibre_material(2) + "}\nregions: {all: {material: m, law: neo_hookean}}"),
              HasSubstr("not isotropic"));
  EXPECT_THAT(message(isotropic + "regions: {all: {material: m, law: neo_hookean, kinematics: linear}}"),
              HasSubstr("no effect"));
  EXPECT_THAT(message(isotropic + "regions: {all: {material: m, law: neo_hookean, formulation: mixed}}"),
              HasSubstr("mixed"));
}

TEST(SwellingInput, AFieldThatNoMaterialUsesIsRefused) {
  EXPECT_THROW(BuiltTestScene("mesh: {type: box, size: [1, 1, 1], cells: [1, 1, 1]}\nmaterials: {m: " +
                              fibre_material(10) + "}\nmoisture: {change: 1}\ntime: {end: 1}"),
               ConfigError);
}

TEST(SwellingModel, CostsNothingWithoutAField) {
  const BuiltTestScene s(block(""));
  EXPECT_TRUE(s.model().parts().loads.empty());
  EXPECT_TRUE(s.model().parts().elastic.front()->added().empty());
}

}  // namespace
}  // namespace orthodyn::swelling_test
