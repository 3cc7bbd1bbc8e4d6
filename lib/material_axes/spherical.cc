// `axes: {type: spherical}`: radial, east and north about a centre, for a shell, a bulb, an eye.
#include "lib/material_axes/axes_source.h"
#include "lib/material_axes/frame.h"

namespace orthodyn {

enum class RenOrder { REN, RNE, ERN, ENR, NRE, NER };

template <>
struct EnumNames<RenOrder> {
  using E = RenOrder;
  static constexpr std::array<std::pair<E, const char*>, 6> list{
      {{E::REN, "REN"}, {E::RNE, "RNE"}, {E::ERN, "ERN"}, {E::ENR, "ENR"}, {E::NRE, "NRE"}, {E::NER, "NER"}}};
};

namespace {

class Spherical : public AxesSource {
 public:
  static const Spec<Spherical>& spec() {
    static const auto s =
        Spec<Spherical>()
            .key("center", &Spherical::center_, "The centre.", {.unit = "m"})
            .key("pole", &Spherical::pole_,
                 "Direction of the north pole, of any length. On the polar axis, N is the coordinate axis least "
                 "aligned with it, projected normal to it; at the centre, R is the pole.")
            .key("order", &Spherical::order_,
                 "Directions of the material axes 1, 2, 3: R radial, E east (about the polar axis), N north.")
            .check([](const Spherical& s_, const Config& config) {
              if (s_.pole_.isZero(0)) config.at("pole").fail("is zero; give a direction");
            });
    return s;
  }

  AxesField field(const Mesh&, Warnings&) const override {
    return [this, pole = Vec3(pole_.stableNormalized())](const Vec3& place, int) {
      const double noise = 1e-12 * (place.norm() + center_.norm());
      Vec3 radial = place - center_;
      if (!(radial.norm() > noise)) radial = pole;
      const bool on_the_poles = radial.cross(pole).norm() <= std::max(noise, 1e-12 * radial.norm());
      const Mat3 rne = frame(radial, on_the_poles ? any_normal(pole) : pole);
      const Mat3 ren = (Mat3() << rne.col(0), -rne.col(2), rne.col(1)).finished();
      return in_order(ren, "REN", Value<RenOrder>::yaml(order_));
    };
  }

 private:
  Vec3 center_ = Vec3::Zero(), pole_{0, 0, 1};
  RenOrder order_ = RenOrder::REN;
};

const bool spherical_registered = Registry<AxesSource>::add<Spherical>(
    "spherical", "Radial, east and north about a centre, at each integration point.");

}  // namespace
}  // namespace orthodyn
