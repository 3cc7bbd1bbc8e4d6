// Transversely isotropic materials: a fibre, with isotropy across it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/core/symmetric_eigen.h"
#include "lib/material/material.h"
#include "tests/config/messages.h"
#include "tests/material/constants.h"

namespace orthodyn::transversely_isotropic_test {
namespace {

std::string fibre_with(double nu_axial, double nu_transverse, const std::string& more = "") {
  return fmt::format(
      "{{type: transversely_isotropic, density: 1, young_axial: 100, young_transverse: 4, nu_axial: {}, nu_transverse: "
      "{}, shear_axial: 3{}}}",
      nu_axial, nu_transverse, more);
}

std::shared_ptr<const Material> read(const std::string& yaml) {
  return Registry<Material>::read(Config::from_text(yaml, "a.yaml"));
}
OrthotropicStiffness stiffness_of(const std::string& yaml) {
  return std::get<OrthotropicStiffness>(read(yaml)->stiffness());
}

TEST(TransverselyIsotropic, IsTheOrthotropicMaterialOfItsConstants) {
  OrthotropicConstants c;
  c.young = {100, 4, 4};
  c.nu12 = c.nu13 = 0.4;
  c.nu23 = 0.25;
  c.g12 = c.g13 = 3;
  c.g23 = 4 / 2.5;
  EXPECT_EQ(voigt(stiffness_of(fibre_with(0.4, 0.25))), voigt(stiffness(c)));
}

TEST(TransverselyIsotropic, DoesNotChangeUnderRotationAboutTheFibre) {
  const Mat6 C = voigt(stiffness_of(fibre_with(0.4, 0.25)));
  for (const double angle : {0.3, 1.0, 2.0}) {
    const Mat6 K = stress_rotation(Eigen::AngleAxisd(angle, Vec3::UnitX()).toRotationMatrix());
    EXPECT_LE((K * C * K.transpose() - C).cwiseAbs().maxCoeff(), 16 * kEps * C.norm());
  }
}

// With a ratio of moduli of 25 the limit 1 - nu_t - 2 nu_a^2 / 25 = 0 is at nu_a = sqrt(25 (1 - nu_t) / 2).
TEST(TransverselyIsotropic, IsAcceptedUpToTheLimitOfTheAxialRatio) {
  for (const double nu_t : {-0.5, 0.0, 0.4, 0.9}) {
    const double limit = std::sqrt(12.5 * (1 - nu_t));
    EXPECT_TRUE(read(fibre_with(limit * (1 - 1e-6), nu_t)));
    EXPECT_TRUE(read(fibre_with(-limit * (1 - 1e-6), nu_t)));
    const std::string message = refusal([&] { read(fibre_with(limit * 1.001, nu_t)); });
    EXPECT_TRUE(holds(message, "1 - nu_transverse - 2 nu_axial^2 young_transverse/young_axial > 0 is violated"));
    EXPECT_TRUE(holds(message, fmt::format("|nu_axial| must be below {:.4g}", limit)));
  }
}

TEST(TransverselyIsotropic, NeedsATransverseRatioBetweenMinusOneAndOne) {
  for (const double nu_t : {-1.0, -1.5, 1.0, 2.0})
    EXPECT_NE(refusal([&] { read(fibre_with(0.1, nu_t)); }), "accepted") << nu_t;
  EXPECT_TRUE(holds(refusal([&] { read(fibre_with(0.1, 1.5)); }), "|nu_transverse| < 1 is violated"));
}

TEST(TransverselyIsotropic, WhenShrunkStaysIsotropicAcrossTheFibre) {
  for (const auto& yaml : {fibre_with(4, 0.5, ", repair: shrink"), fibre_with(0.1, -1.5, ", repair: shrink")}) {
    const Mat6 C = voigt(stiffness_of(yaml));
    EXPECT_NEAR(C(4, 4), 0.5 * (C(1, 1) - C(1, 2)), 16 * kEps * C.norm());
    EXPECT_GT(symmetric_eigenvalues(C)[0], 0);
    EXPECT_EQ(read(yaml)->notes().size(), 1u);
  }
}

}  // namespace
}  // namespace orthodyn::transversely_isotropic_test
