// Stress and strain of one region in frames and probes: at an interface each region has its own values.
#include <gtest/gtest.h>

#include "lib/simulation/output/json.h"
#include "tests/simulation/result_reader.h"
#include "tests/simulation/run_program.h"

namespace orthodyn::region_fields_test {
namespace {

constexpr double kStrain = 1e-3, kSoft = 1e6, kStiff = 4e6;  // -, Pa

// Two layers under the same stretch.
class RegionFields : public InFolder {
 protected:
  RegionFields() {
    write("layers.yaml", R"(
analysis: static
mesh: {type: box, size: [1, 0.2, 0.2], cells: [4, 2, 2], parts: {upper: {min: [0, 0, 0.1], max: [1, 0.2, 0.2]}}}
materials:
  soft: {type: isotropic, density: 1000, young: 1e6, nu: 0}
  stiff: {type: isotropic, density: 1000, young: 4e6, nu: 0, strength: {tension: 8e3, compression: 8e3, shear: 8e3}}
regions: {body: {material: soft}, upper: {material: stiff}}
clamps: [{surface: x0}]
motions: [{surface: x1, translation: [0.001, 0, 0], factor: {type: ramp, end: 1}}]
time: {end: 1}
output:
  fields: [displacement, upper.nodal_stress]
  probes:
    border: {at: [0.5, 0.1, 0.1], fields: [body.von_mises, upper.von_mises, upper.max_stress]}
)");
  }
};

TEST_F(RegionFields, AreThoseOfEachSideOfABorder) {
  const auto result = orthodyn("run layers.yaml --quiet --out out");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto last = read_rows(folder_ / "out/probes.csv").back();
  ASSERT_EQ(last.size(), 4u);
  EXPECT_NEAR(last[1], kSoft * kStrain, 0.01 * kSoft * kStrain);
  EXPECT_NEAR(last[2], kStiff * kStrain, 0.01 * kStiff * kStrain);
  EXPECT_NEAR(last[3], kStiff * kStrain / 8e3, 0.01);
  EXPECT_NE(read_text(folder_ / "out/frames/frame_00000.vtu").find("\"upper.nodal_stress\""), std::string::npos);
}

TEST_F(RegionFields, AreRefusedWhereTheRegionIsNotOrHasNoStrength) {
  const std::string run = "run layers.yaml --quiet --out out --set output.probes.border.";
  const auto elsewhere = orthodyn(run + "'at=[0.5, 0.1, 0]'");
  EXPECT_EQ(elsewhere.exit_code, 2);
  EXPECT_NE(elsewhere.output.find("'upper.von_mises': the probe's node is not in region upper"), std::string::npos)
      << elsewhere.output;
  const auto weak = orthodyn(run + "fields=[body.max_stress]");
  EXPECT_EQ(weak.exit_code, 2);
  EXPECT_NE(weak.output.find("needs the strengths of the material of region body"), std::string::npos) << weak.output;
  const auto unknown = orthodyn(run + "fields=[uper.von_mises]");
  EXPECT_NE(unknown.output.find("did you mean 'upper.von_mises'"), std::string::npos) << unknown.output;
}

// The finer mesh of the error estimate has two cells through the thickness and divides the middle ply.
TEST_F(RegionFields, OfAPlyHaveAMeshErrorWhateverItsNumberOfParts) {
  write("plies.yaml", R"(
analysis: static
mesh: {type: box, size: [0.2, 0.1, 0.003], cells: [4, 2, 1], elements: hexahedra}
materials: {m: {type: isotropic, density: 1000, young: 1e9, nu: 0.3}}
regions: {body: {layup: [[m, 0, 1 mm], [m, 90 deg, 1 mm], [m, 0, 1 mm]], axes: {first: [1, 0, 0], second: [0, 1, 0]}}}
clamps: [{surface: x0}]
loads: [{surface: x1, force: [0, 0, -0.01]}]
output: {probes: {p: {at: [0.1, 0.05, 0.003], fields: [body.ply_2.von_mises]}}}
)");
  const auto result = orthodyn("run plies.yaml --out out");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NE(result.output.find("body.ply_2.von_mises of p"), std::string::npos) << result.output;
  const auto wrong = orthodyn("run plies.yaml --force --out out --set output.extremes=[body.ply_4.von_mises.largest]");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.output.find("no region or ply 'body.ply_4'; did you mean 'body.ply_1'? There are body, body.ply_1"),
            std::string::npos)
      << wrong.output;
}

}  // namespace
}  // namespace orthodyn::region_fields_test
