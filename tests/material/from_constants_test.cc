// Materials made from constants are those that the input makes, and refuse what the input refuses.
#include "lib/material/from_constants.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/core/messages.h"
#include "tests/material/constants.h"

namespace orthodyn {
namespace {

TEST(FromConstants, AnOrthotropicMaterialHasTheStiffnessOfItsConstants) {
  const auto material = make_orthotropic(400, spruce());
  EXPECT_EQ(material->density(), 400);
  EXPECT_EQ(voigt(std::get<OrthotropicStiffness>(material->stiffness())), voigt(stiffness(spruce())));
}

TEST(FromConstants, AnIsotropicMaterialHasTheLameConstants) {
  const auto C = std::get<IsotropicStiffness>(make_isotropic(1, 5, 0.25)->stiffness());
  EXPECT_DOUBLE_EQ(C.lambda, 2);
  EXPECT_DOUBLE_EQ(C.mu, 2);
}

TEST(FromConstants, AnUnstableSetIsRefusedWithTheNearestStableOne) {
  auto c = spruce();
  c.nu23 = 1.7;
  const std::string message = refusal([&] { make_orthotropic(1, c); });
  EXPECT_TRUE(holds(message, "make the stiffness indefinite"));
  EXPECT_TRUE(holds(message, "Nearest stable set"));
}

TEST(FromConstants, NumbersOutOfRangeAreRefusedByName) {
  EXPECT_TRUE(holds(refusal([] { make_isotropic(0, 1, 0.3); }), "the density must be a positive number, found 0"));
  EXPECT_TRUE(holds(refusal([] { make_isotropic(1, -2, 0.3); }), "Young's modulus must be"));
  EXPECT_TRUE(holds(refusal([] { make_isotropic(1, 1, 0.5); }), "Poisson's ratio must be in (-1, 0.5), found 0.5"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(holds(refusal([&] { make_isotropic(1, 1, nan); }), "Poisson's ratio must be in (-1, 0.5)"));
  for (const double bad : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    auto c = spruce();
    c.g13 = bad;
    EXPECT_TRUE(holds(refusal([&] { make_orthotropic(1, c); }), "G13 must be a positive number"));
  }
  auto c = spruce();
  c.nu13 = nan;
  EXPECT_TRUE(holds(refusal([&] { make_orthotropic(1, c); }), "nu13 must be a finite number"));
}

}  // namespace
}  // namespace orthodyn
