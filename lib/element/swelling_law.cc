#include "lib/element/swelling_law.h"

#include "lib/core/errors.h"
#include "lib/element/corotational_law.h"
#include "lib/element/lanes.h"

namespace orthodyn {

namespace {

Batch::Mask regular(const Mat3T<Batch>& F, Polar<Batch>& p) {
  const Batch::Mask good = polar(F, p);
  return good & is_regular<Batch>(p.S, p.det_G);
}

// -(s + [c]) for chi = 1; e = S - I.
template <class T>
Mat3T<T> regular_stress(const Polar<T>& p, const Mat3T<T>& e, const Mat3T<T>& s) {
  const Vec3T<T> c = p.G_inverse * axial<T>(e * s);  // = a(S s), as a(s) = 0
  return -(s + cross_matrix<T>(c));
}

struct Point {
  Mat3 e;
  Polar<double> p;
  Blend<double> b;
  Point(const Mat3& H, const Mat3& Q) : p(polar(deformation_gradient<double>(H, Q), Q)) {
    e = stretch_strain<double>(H, Q, p.S);
    b = blend<double>(p.S, p.det_G);
  }
};

Mat3 blended_stress(const Mat3& H, const Mat3& Q, const Mat3& s) {
  const Point at(H, Q);
  const double mean = s.trace() / 3;
  const Mat3 turned = at.b.chi > 0 ? Mat3(at.b.chi * regular_stress<double>(at.p, at.e, s)) : Mat3(Mat3::Zero());
  const double excess = mean * at.e.trace() - contract<double>(s, at.e);
  return at.p.R * (turned - (1 - at.b.chi) * mean * Mat3::Identity() + excess * at.b.gradient);
}

double blended_energy(const Mat3& H, const Mat3& Q, const Mat3& s) {
  const Point at(H, Q);
  return -at.b.chi * contract<double>(s, at.e) - (1 - at.b.chi) * s.trace() / 3 * at.e.trace();
}

}  // namespace

Mat3T<Batch> swelling_stress(const Mat3T<Batch>& H, const Mat3T<Batch>& Q, const Mat3T<Batch>& s) {
  Polar<Batch> p;
  const Batch::Mask good = regular(deformation_gradient<Batch>(H, Q), p);
  Mat3T<Batch> P = p.R * regular_stress<Batch>(p, stretch_strain<Batch>(H, Q, p.S), s);
  for_each_lane_outside(good,
                        [&](int l) { set_lane(P, l, blended_stress(lane_of(H, l), lane_of(Q, l), lane_of(s, l))); });
  return P;
}

Batch swelling_energy(const Mat3T<Batch>& H, const Mat3T<Batch>& Q, const Mat3T<Batch>& s) {
  Polar<Batch> p;
  const Batch::Mask good = regular(deformation_gradient<Batch>(H, Q), p);
  Batch energy = -contract<Batch>(s, stretch_strain<Batch>(H, Q, p.S));
  for_each_lane_outside(
      good, [&](int l) { set_lane(energy, l, blended_energy(lane_of(H, l), lane_of(Q, l), lane_of(s, l))); });
  return energy;
}

void add_swelling_moduli(const Mat3T<Batch>& H, const Mat3T<Batch>& Q, const Mat3T<Batch>& s, Mat9T<Batch>& K) {
  Polar<Batch> p;
  const Batch::Mask good = regular(deformation_gradient<Batch>(H, Q), p);
  constexpr OrthotropicStiffness kNone{};
  const auto form = exact_form(p, kNone, regular_stress<Batch>(p, stretch_strain<Batch>(H, Q, p.S), s));
  Mat9T<Batch> all = expand(form);
  turn_to_space<Batch>(form.R, all);
  for (int i = 0; i < 81; ++i) K(i) += select(good, all(i), Batch(0));
}

Mat3T<Batch> mean_swelling_stress(const Mat3T<Batch>& H0, const Mat3T<Batch>& H1, const Mat3T<Batch>& Q,
                                  const Mat3T<Batch>& s) {
  Polar<Batch> p0, p1;
  const Batch::Mask good =
      regular(deformation_gradient<Batch>(H0, Q), p0) & regular(deformation_gradient<Batch>(H1, Q), p1);
  const Mat3T<Batch> F = deformation_gradient<Batch>(Batch(0.5) * (H0 + H1), Q);
  const auto between = [](const auto& F_mean, const auto& S0, const auto& S1, const auto& stress) {
    using T = std::decay_t<decltype(F_mean(0, 0))>;
    return Mat3T<T>(F_mean * solve_lyapunov<T>(T(0.5) * (S0 + S1), T(-2) * stress));
  };
  Mat3T<Batch> P = between(F, p0.S, p1.S, s);
  for_each_lane_outside(good, [&](int l) {
    const Point at0(lane_of(H0, l), lane_of(Q, l)), at1(lane_of(H1, l), lane_of(Q, l));
    for (const Point* at : {&at0, &at1})
      if (!(at->p.S.determinant() > 0) || at->b.chi < 1)
        throw RecoverableError(
            "an element is inverted or flat; the force of energy-conserving steps is undefined there");
    set_lane(P, l, between(lane_of(F, l), at0.p.S, at1.p.S, lane_of(s, l)));
  });
  return P;
}

}  // namespace orthodyn
