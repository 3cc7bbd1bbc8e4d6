// A bar of a fibre 100 times stiffer along x: by the formulas it kinks at -6.64 % and slides at +18.2 %.
// Under a uniform traction its linear strain is traction / 100; the check takes twice that.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/simulation/run/setup.h"
#include "tests/config/messages.h"

namespace orthodyn::strain_check_test {
namespace {

std::string bar(const std::string& more, const std::string& axes = "") {
  return "mesh: {type: box, size: [2, 1, 1], cells: [2, 1, 1], order: 1}\n"
         "materials: {wood: {type: orthotropic_stable, density: 1, young: [100, 1, 1], nu: 0.3}}\n"
         "regions: {all: {material: wood" +
         axes +
         "}}\n"
         "clamps: [{surface: x0, components: [x]}, {nearest: [0, 0, 0]}, {nearest: [0, 1, 0], components: [z]}]\n"
         "time: {end: 1}\n" +
         more;
}

const std::string kFree =
    "mesh: {type: box, size: [2, 1, 1], cells: [2, 1, 1], order: 1}\n"
    "materials: {m: {type: orthotropic_stable, density: 1, young: [100, 1, 1], nu: 0.3}}\ntime: {end: 1}\n";

// The warnings about strains.
Warnings warnings_of(const std::string& yaml) {
  Warnings out;
  for (const auto& warning : set_up(Config::from_text(yaml)).built.warnings)
    if (warning.rfind("region ", 0) == 0) out.push_back(warning);
  return out;
}

std::string pulled_by(double traction) {
  return fmt::format("loads: [{{surface: x1, traction: [{}, 0, 0]}}]\n", traction);
}

TEST(StrainCheck, WarnsOfACompressionThatKinksTheFibre) {
  EXPECT_TRUE(warnings_of(bar(pulled_by(-3.30))).empty());
  const auto warnings = warnings_of(bar(pulled_by(-3.34)));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(holds(warnings[0], "10 of 10 elements along material axis 1") && holds(warnings[0], "-6.68 %"));
  EXPECT_TRUE(holds(warnings[0], "-6.64 %"));
  EXPECT_TRUE(holds(warnings[0], "kinks in the plane 1-"));
}

TEST(StrainCheck, WarnsOfATensionThatSlidesTheLayers) {
  EXPECT_TRUE(warnings_of(bar(pulled_by(9.0))).empty());
  const auto warnings = warnings_of(bar(pulled_by(9.2)));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(holds(warnings[0], "+18.4 %") && holds(warnings[0], "+18.2 %"));
}

TEST(StrainCheck, LooksAlongTheMaterialAxes) {
  const std::string across = ", axes: {first: [0, 1, 0], second: [1, 0, 0]}";
  EXPECT_TRUE(warnings_of(bar(pulled_by(-0.05), across)).empty());  // E = 1 along x now; -10 %
}

// nu21 = 0.03: twice 160 % strain across the fibre causes -9.6 % along it, but without stress along it.
TEST(StrainCheck, TakesNoContractionThatGoesWithTensionForALoad) {
  EXPECT_TRUE(warnings_of(bar(pulled_by(1.6), ", axes: {first: [0, 1, 0], second: [1, 0, 0]}")).empty());
}

TEST(StrainCheck, TakesALoadAtThePeakOfItsFactor) {
  const std::string sine =
      "loads: [{surface: x1, traction: [-33.4, 0, 0], factor: {type: sine, amplitude: 0.1, frequency: 1}}]\n";
  EXPECT_EQ(warnings_of(bar(sine)).size(), 1u);
}

TEST(StrainCheck, IsForCorotationalKinematicsOnly) {
  EXPECT_TRUE(warnings_of(bar(pulled_by(-30) + "elasticity: {kinematics: linear}\n")).empty());
}

TEST(StrainCheck, WarnsOfAnInitialDeformationBeyondTheLimit) {
  const auto deformed = [](const std::string& F) {
    return warnings_of(kFree + "initial: {deformation_gradient: " + F + "}\n");
  };
  // nu12 = 3: stress along the fibre alone.
  EXPECT_TRUE(deformed("[[0.94, 0, 0], [0, 1.18, 0], [0, 0, 1.18]]").empty());
  const auto warnings = deformed("[[0, -1.3, 0], [0.9, 0, 0], [0, 0, 1.3]]");  // turned, too
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(holds(warnings[0], "the initial deformation strains 10 of 10"));
  EXPECT_TRUE(holds(warnings[0], " of -10 %"));
}

TEST(StrainCheck, DoesNotTakeARotationForAStrain) {
  EXPECT_TRUE(warnings_of(kFree + "initial: {deformation_gradient: [[0, -1, 0], [1, 0, 0], [0, 0, 1]]}\n").empty());
}

}  // namespace
}  // namespace orthodyn::strain_check_test
