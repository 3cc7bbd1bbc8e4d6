#include "lib/scene/elasticity.h"

namespace orthodyn {

template <>
struct EnumNames<Corotation> {
  static constexpr std::array<std::pair<Corotation, const char*>, 2> list{
      {{Corotation::exact, "exact"}, {Corotation::warped, "warped"}}};
};

template <>
struct EnumNames<WarpedTangent> {
  static constexpr std::array<std::pair<WarpedTangent, const char*>, 2> list{
      {{WarpedTangent::rotated, "rotated"}, {WarpedTangent::unsymmetric, "unsymmetric"}}};
};

const Spec<Elasticity>& Elasticity::spec() {
  static const auto s =
      Spec<Elasticity>()
          .key(
              "kinematics", &Elasticity::kinematics,
              "corotational: large rotations. linear: small strain with a constant K. auto, for each region: linear if "
              "this is accurate enough for the whole run, otherwise corotational from the start; the summary gives "
              "the choice and the reason.")
          .key("linear_error", &Elasticity::linear_error,
               "With kinematics: auto, the allowed error of displacements by linear kinematics, relative to the "
               "largest displacement; default ten times integrator.rtol, or 1e-3 without rtol.",
               {.range = {0, 1, true}})
          .key("corotation", &Elasticity::corotation,
               "exact: gradient of the energy. warped: R sigma as in Mueller & Gross 2004 and Vega FEM, for "
               "comparison; it gains energy and exerts a net torque for anisotropic materials.")
          .key("warped_tangent", &Elasticity::warped_tangent,
               "Tangent of the warped force: R K R^T, or its exact unsymmetric derivative (klu, klu_full).")
          .check([](const Elasticity& e, const Config& config) {
            const bool warped = e.corotation == Corotation::warped;
            if (warped && e.kinematics == Kinematics::linear)
              config.at("corotation").fail("has no effect with kinematics: linear; remove one of them");
            if (warped && e.kinematics == Kinematics::automatic)
              config.at("kinematics")
                  .fail("auto supports the exact force only; with corotation: warped set linear or corotational");
            if (e.warped_tangent == WarpedTangent::unsymmetric && !warped)
              config.at("warped_tangent").fail("has no effect without corotation: warped; remove it");
          });
  return s;
}

}  // namespace orthodyn
