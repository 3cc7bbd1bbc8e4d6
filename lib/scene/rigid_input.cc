#include "lib/scene/rigid_input.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

namespace orthodyn {

namespace {

// The principal moments of a body satisfy J1 + J2 >= J3, because Euler's tensor has the principal values (J1 + J2 -
// J3)/2 and so on. Where the sum is J3, the body has no thickness along the third axis, and an affine motion along this
// axis would have no mass (rigid_body.h).
void check_moments(const GivenInertia& given, const Config& config) {
  constexpr double kFlat = 1e-10;  // relative to the largest moment
  const Config place = config.at("inertia");
  if (given.inertia.size() != 3 && given.inertia.size() != 6)
    place.fail_expected("a list of 3 moments xx, yy, zz, or of 6 with xy, yz, zx");
  const Vec3 J = Eigen::SelfAdjointEigenSolver<Mat3>(given.moments(), Eigen::EigenvaluesOnly).eigenvalues();
  const double thickness = J[0] + J[1] - J[2];
  if (J[2] > 0 && thickness > kFlat * J[2]) return;
  const std::string found = fmt::format("the principal moments are {:.6g}, {:.6g} and {:.6g} kg m^2", J[0], J[1], J[2]);
  if (J[2] > 0 && thickness >= -kFlat * J[2])
    place.fail(
        found +
        ", those of a body without thickness: the largest must be below the sum of the others. Add "
        "mass thickness^2/12 to the moments about two axes in the plane; in a plane motion, only the moment about "
        "its normal counts, and all three may have this value");
  place.fail(found +
             ", which no body has: each must be positive and below the sum of the two others. Moments are about the "
             "centre, and xy is -integral of density x y");
}

}  // namespace

const Spec<GivenInertia>& GivenInertia::spec() {
  using G = GivenInertia;
  static const auto s =
      Spec<G>()
          .key("mass", &G::mass, "Mass of the region.", {.required = true, .unit = "kg", .range = kPositive})
          .key("center", &G::center, "Centre of mass in space, at rest.", {.required = true, .unit = "m"})
          .key("inertia", &G::inertia,
               "Moments of inertia about the centre along the axes of space, at rest: xx, yy, zz, or xx, yy, zz, xy, "
               "yz, zx, where xy is -integral of density x y.",
               {.required = true, .unit = "kg m^2"})
          .check(check_moments);
  return s;
}

Mat3 GivenInertia::moments() const {
  Mat3 J = Vec3(inertia[0], inertia[1], inertia[2]).asDiagonal();
  if (inertia.size() == 3) return J;
  J(0, 1) = J(1, 0) = inertia[3];
  J(1, 2) = J(2, 1) = inertia[4];
  J(2, 0) = J(0, 2) = inertia[5];
  return J;
}

RigidInput Value<RigidInput>::read(const Config& c, const Rule&) {
  if (!c.is_map()) return {c.boolean()};
  const GivenInertia given = GivenInertia::spec().read(c);
  return {true, RigidInertia{given.mass, given.center, given.moments()}};
}

}  // namespace orthodyn
