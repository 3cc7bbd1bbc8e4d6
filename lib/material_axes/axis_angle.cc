// `axes: {type: axis_angle}`: the coordinate axes rotated about a direction, the same in all elements.
#include "lib/material_axes/axes_source.h"

namespace orthodyn {
namespace {

class AxisAngle : public AxesSource {
 public:
  static const Spec<AxisAngle>& spec() {
    static const auto s =
        Spec<AxisAngle>()
            .key("axis", &AxisAngle::axis_, "Direction of the rotation axis, of any length.", {.required = true})
            .key("angle", &AxisAngle::angle_, "Rotation angle, right-handed.", {.required = true, .unit = "rad"})
            .check([](const AxisAngle& a, const Config& config) {
              if (a.axis_.isZero(0)) config.at("axis").fail("is zero; give a direction");
            });
    return s;
  }

  bool uniform() const override { return true; }

  AxesField field(const Mesh&, Warnings&) const override {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(angle_, axis_.stableNormalized()));
    return [Q = q.normalized().toRotationMatrix()](const Vec3&, int) { return Q; };
  }

 private:
  Vec3 axis_{0, 0, 1};
  double angle_ = 0;
};

const bool axis_angle_registered =
    Registry<AxesSource>::add<AxisAngle>("axis_angle", "The coordinate axes rotated about a direction.");

}  // namespace
}  // namespace orthodyn
