// `axes: {type: euler}`: the same rotation in all elements, by three angles.
#include "lib/material_axes/axes_source.h"

namespace orthodyn {

enum class EulerConvention { xyz, xzy, yxz, yzx, zxy, zyx, xyx, xzx, yxy, yzy, zxz, zyz };

template <>
struct EnumNames<EulerConvention> {
  using E = EulerConvention;
  static constexpr std::array<std::pair<E, const char*>, 12> list{{{E::xyz, "xyz"},
                                                                   {E::xzy, "xzy"},
                                                                   {E::yxz, "yxz"},
                                                                   {E::yzx, "yzx"},
                                                                   {E::zxy, "zxy"},
                                                                   {E::zyx, "zyx"},
                                                                   {E::xyx, "xyx"},
                                                                   {E::xzx, "xzx"},
                                                                   {E::yxy, "yxy"},
                                                                   {E::yzy, "yzy"},
                                                                   {E::zxz, "zxz"},
                                                                   {E::zyz, "zyz"}}};
};

namespace {

// Q = R_a(angle 1) R_b(angle 2) R_c(angle 3) for the convention abc. These are rotations about a, then the rotated b,
// then the twice rotated c (intrinsic), or equivalently about the fixed c, then b, then a (extrinsic).
class Euler : public AxesSource {
 public:
  static const Spec<Euler>& spec() {
    static const auto s = Spec<Euler>()
                              .key("angles", &Euler::angles_, "The three angles, in the order of the convention.",
                                   {.required = true, .unit = "rad"})
                              .key("convention", &Euler::convention_,
                                   "Rotation axes, intrinsic: zyx rotates x, y, z about z, then about the new y, then "
                                   "about the new x; the result is the axes 1, 2, 3.",
                                   {.required = true});
    return s;
  }

  bool uniform() const override { return true; }

  AxesField field(const Mesh&, Warnings&) const override {
    const std::string axes = Value<EulerConvention>::yaml(convention_);
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    for (std::size_t i = 0; i < 3; ++i)
      q = q * Eigen::AngleAxisd(angles_[static_cast<Eigen::Index>(i)], Vec3::Unit(axes[i] - 'x'));
    return [Q = q.normalized().toRotationMatrix()](const Vec3&, int) { return Q; };
  }

 private:
  Vec3 angles_ = Vec3::Zero();
  EulerConvention convention_ = EulerConvention::zyx;
};

const bool euler_registered =
    Registry<AxesSource>::add<Euler>("euler", "The same rotation everywhere, by three angles.");

}  // namespace
}  // namespace orthodyn
