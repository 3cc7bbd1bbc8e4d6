// Materials registered by plugins that have inadmissible constants.
#include <limits>

#include "lib/material/material.h"
#include "tests/scene/scenes.h"

namespace orthodyn::admissible_material_test {
namespace {

class Unchecked : public Material {
 public:
  static const Spec<Unchecked>& spec() {
    static const auto s = Spec<Unchecked>()
                              .key("density", &Unchecked::density_, "Density.")
                              .key("c11", &Unchecked::c11_, "C11 = C22 = C33.")
                              .key("c12", &Unchecked::c12_, "C12 = C23 = C31.")
                              .key("c44", &Unchecked::c44_, "G12 = G23 = G31.")
                              .key("skew", &Unchecked::skew_, "C14 without C41.");
    return s;
  }
  Stiffness stiffness() const override {
    AnisotropicStiffness out;
    out.c.topLeftCorner<3, 3>().setConstant(c12_);
    out.c.diagonal() << c11_, c11_, c11_, c44_, c44_, c44_;
    out.c(0, 3) = skew_;
    if (c11_ == 77) out.c(1, 1) = std::numeric_limits<double>::quiet_NaN();
    return out;
  }

 private:
  double c11_ = 2, c12_ = 1, c44_ = 1, skew_ = 0;
};

const bool registered = Registry<Material>::add<Unchecked>("unchecked", "For tests.");

std::string scene_of(const std::string& constants) {
  return replaced(kValidScene, "type: isotropic, density: 1000, young: 1e6, nu: 0.3", "type: unchecked, " + constants);
}
std::string refused(const std::string& constants) { return refusal(scene_of(constants)); }
void accept(const std::string& constants) { EXPECT_NO_THROW(build_text(scene_of(constants))) << constants; }

TEST(MaterialsOfPlugins, MustBePositiveDefinite) {
  accept("density: 1");
  // The eigenvalues of the normal part are c11 - c12 (twice) and c11 + 2 c12.
  EXPECT_NE(refused("density: 1, c12: 2.5")
                .find("scene.yaml:3:9: materials.soft: cannot be used: its stiffness is not positive definite: the "
                      "smallest eigenvalue is -0.5"),
            std::string::npos)
      << refused("density: 1, c12: 2.5");
  accept("density: 1, c12: -0.99");
  EXPECT_NE(refused("density: 1, c12: -1.01").find("not positive definite"), std::string::npos);
  EXPECT_NE(refused("density: 1, c44: 0").find("not positive definite"), std::string::npos);
  EXPECT_NE(refused("density: 1, c44: -1").find("diagonal is -1 Pa"), std::string::npos);
  accept("density: 1, c11: 2e12, c12: 1e12, c44: 1e-3");  // moduli decades apart
}

TEST(MaterialsOfPlugins, MustBeFiniteSymmetricAndHaveMass) {
  EXPECT_NE(refused("density: 0").find("its density is 0 kg/m^3"), std::string::npos);
  EXPECT_NE(refused("density: -3").find("its density is -3 kg/m^3"), std::string::npos);
  EXPECT_NE(refused("density: 1, c11: 77").find("not finite"), std::string::npos);
  EXPECT_NE(refused("density: 1, skew: 0.1").find("not symmetric"), std::string::npos);
}

}  // namespace
}  // namespace orthodyn::admissible_material_test
