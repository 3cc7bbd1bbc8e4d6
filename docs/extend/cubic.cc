// Example of a user's material: an elastic law of cubic symmetry, as of many metals, with three constants.
#include "lib/material/material.h"

namespace {

using namespace orthodyn;

class Cubic : public Material {
 public:
  static const Spec<Cubic>& spec() {
    const Rule modulus{.required = true, .unit = "Pa", .range = kPositive};
    static const auto s =
        Spec<Cubic>()
            .key("density", &Cubic::density_, "Mass density.", {.required = true, .unit = "kg/m^3", .range = kPositive})
            .key("c11", &Cubic::c11_, "Stiffness along a crystal axis at no lateral strain.", modulus)
            .key("c12", &Cubic::c12_, "Stress along a crystal axis per strain along another one.",
                 {.required = true, .unit = "Pa"})
            .key("c44", &Cubic::c44_, "Shear modulus in the planes of the axes.", modulus)
            .check([](const Cubic& c, const Config& config) {
              if (c.c11_ <= std::abs(c.c12_) || c.c11_ + 2 * c.c12_ <= 0)
                config.at("c12").fail("must lie in (-c11/2, c11), else the stiffness is not positive definite");
            });
    return s;
  }

  Stiffness stiffness() const override {
    return OrthotropicStiffness{c11_, c11_, c11_, c12_, c12_, c12_, c44_, c44_, c44_};
  }

 private:
  double c11_ = 0, c12_ = 0, c44_ = 0;
};

const bool cubic_registered = Registry<Material>::add<Cubic>("cubic", "Cubic symmetry: c11, c12, c44.");

}  // namespace
