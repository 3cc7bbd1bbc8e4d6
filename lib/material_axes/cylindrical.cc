// `axes: {type: cylindrical}`: axial, radial and tangential about a straight axis, for a stem or a tube.
#include "lib/material_axes/axes_source.h"
#include "lib/material_axes/frame.h"
#include "lib/material_axes/lrt.h"

namespace orthodyn {
namespace {

class Cylindrical : public AxesSource {
 public:
  static const Spec<Cylindrical>& spec() {
    static const auto s =
        Spec<Cylindrical>()
            .key("point", &Cylindrical::point_, "A point of the axis.", {.unit = "m"})
            .key("axis", &Cylindrical::axis_,
                 "Direction L of the axis, of any length. On the axis itself, R is the coordinate axis least aligned "
                 "with it, projected normal to it.")
            .key("order", &Cylindrical::order_, kLrtSentence)
            .key("spiral", &Cylindrical::spiral_, kSpiralSentence, {.unit = "rad", .range = kSpiralRange})
            .check([](const Cylindrical& c, const Config& config) {
              if (c.axis_.isZero(0)) config.at("axis").fail("is zero; give a direction");
            });
    return s;
  }

  AxesField field(const Mesh&, Warnings&) const override {
    return [this, L = Vec3(axis_.stableNormalized())](const Vec3& place, int) {
      const Vec3 arm = place - point_, radial = arm - L.dot(arm) * L;
      const double noise = 1e-12 * (place.norm() + point_.norm());
      return lrt_axes(L, radial.norm() > noise ? radial : any_normal(L), order_, spiral_);
    };
  }

 private:
  Vec3 point_ = Vec3::Zero(), axis_{0, 0, 1};
  LrtOrder order_ = LrtOrder::LRT;
  double spiral_ = 0;  // rad
};

const bool cylindrical_registered = Registry<AxesSource>::add<Cylindrical>(
    "cylindrical", "L, R, T about a straight axis, at each integration point: a stem, a tube.");

}  // namespace
}  // namespace orthodyn
