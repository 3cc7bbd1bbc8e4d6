#include "lib/element/turned_strain.h"

#include "lib/element/corotational_law.h"

namespace orthodyn {

Mat3T<Batch> turned_strain(const Mat3T<Batch>& H, const Mat3T<Batch>& Q) {
  Polar<Batch> p;
  const Batch::Mask good = polar(deformation_gradient<Batch>(H, Q), p);
  Mat3T<Batch> e = stretch_strain<Batch>(H, Q, p.S);
  for_each_lane_outside(good, [&](int l) {
    const Mat3 own_H = lane_of(H, l), own_Q = lane_of(Q, l);
    set_lane(e, l, stretch_strain<double>(own_H, own_Q, polar(deformation_gradient<double>(own_H, own_Q), own_Q).S));
  });
  return e;
}

Mat3T<Batch> turned_strain_change(const Mat3T<Batch>& H, const Mat3T<Batch>& Q, const Mat3T<Batch>& dH) {
  Polar<Batch> p;
  const Batch::Mask good = polar(deformation_gradient<Batch>(H, Q), p);
  const Mat3T<Batch> change = stretch_change<Batch>(p, dH);
  const Batch::Mask regular = good & is_regular<Batch>(p.S, p.det_G);
  return change.unaryExpr([&](const Batch& x) { return select(regular, x, Batch(0)); });
}

void add_strain_moduli(const Mat3T<Batch>& H, const Mat3T<Batch>& Q, const AnisotropicStiffness& C, Mat9T<Batch>& K) {
  Polar<Batch> p;
  const Batch::Mask good = polar(deformation_gradient<Batch>(H, Q), p);
  const Batch::Mask regular = good & is_regular<Batch>(p.S, p.det_G);
  const auto form = gauss_newton_form(p, C);
  Mat9T<Batch> all = expand(form);
  turn_to_space<Batch>(form.R, all);
  for (int i = 0; i < 81; ++i) K(i) += select(regular, all(i), Batch(0));
}

void add_linear_strain_moduli(const Mat3T<Batch>& Q, const AnisotropicStiffness& C, Mat9T<Batch>& K) {
  Mat9T<Batch> all = expand(TangentFormOf<AnisotropicStiffness, Batch>{Q, C, Mat63T<Batch>::Zero(),
                                                                       Mat36T<Batch>::Zero(), Mat3T<Batch>::Zero()});
  turn_to_space<Batch>(Q, all);
  K += all;
}

}  // namespace orthodyn
