// The key `rigid` of a region: false, true, or a section with mass, centre and moments of inertia.
#pragma once

#include <optional>
#include <vector>

#include "lib/config/spec.h"
#include "lib/fem/rigid_body.h"

namespace orthodyn {

struct GivenInertia {
  double mass = 0;              // kg
  Vec3 center = Vec3::Zero();   // m, in space at rest
  std::vector<double> inertia;  // kg m^2: xx, yy, zz, or xx, yy, zz, xy, yz, zx
  // Throws ConfigError unless Euler's tensor of the moments is positive definite.
  static const Spec<GivenInertia>& spec();

  Mat3 moments() const;
};

struct RigidInput {
  bool is_rigid = false;
  std::optional<RigidInertia> inertia = {};  // empty: computed from the mesh and the density
};

template <>
struct Value<RigidInput> {
  static ValueSchema schema() {
    return {.kind = ValueSchema::Kind::either, .items = {Value<bool>::schema(), Value<GivenInertia>::schema()}};
  }
  static RigidInput read(const Config& c, const Rule& r);
  static std::string yaml(const RigidInput& rigid) { return Value<bool>::yaml(rigid.is_rigid); }
};

}  // namespace orthodyn
