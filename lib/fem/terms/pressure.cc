#include "lib/fem/terms/pressure.h"

#include "lib/element/axial.h"
#include "lib/fem/term_choice.h"
#include "lib/fem/terms/dead_load.h"
#include "lib/mesh/selection.h"

namespace orthodyn {

namespace {

Vec3 area_vector(const NodalVector& x, const Triangle& t) {
  const Vec3 base = x.col(t[0]);
  return 0.5 * (x.col(t[1]) - base).cross(x.col(t[2]) - base);
}

// [opposite side of node b]: 2 da/dx_b.
Mat3 area_gradient(const NodalVector& x, const Triangle& t, std::size_t b) {
  return cross_matrix<double>(x.col(t[(b + 2) % 3]) - x.col(t[(b + 1) % 3]));
}

}  // namespace

Pressure::Pressure(std::string surface, std::vector<Triangle> triangles, double pressure,
                   std::shared_ptr<const TimeFunction> factor, const BlockPattern& pattern)
    : surface_(std::move(surface)), triangles_(std::move(triangles)), pressure_(pressure), factor_(std::move(factor)),
      pattern_(pattern) {}

void Pressure::add_force_of(double pressure, const NodalVector& x, NodalVector& f) const {
  for (const Triangle& t : triangles_) {
    const Vec3 third = -pressure / 3 * area_vector(x, t);
    for (const int node : t) f.col(node) += third;
  }
}

void Pressure::add_force(const NodalState& s, NodalVector& f) const {
  add_force_of(pressure_ * factor_->value(s.t), s.x, f);
}

void Pressure::add_peak_force(const NodalState& s, double end, NodalVector& f) const {
  add_force_of(pressure_ * factor_->peak(s.t, end), s.x, f);
}

void Pressure::add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double*) const {
  if (kind == TangentKind::gauss_newton) return;  // indefinite
  const double p = pressure_ * factor_->value(s.t);
  for (const Triangle& t : triangles_)
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) {
        if (pattern_.symmetric() && t[a] <= t[b]) continue;  // the diagonal's symmetric part is zero
        Mat3 block = p / 6 * area_gradient(s.x, t, b);
        if (pattern_.symmetric()) block = 0.5 * (block - p / 6 * area_gradient(s.x, t, a));
        pattern_.add(t[a], t[b], pattern_.offset(t[a], t[b]), block, stiffness);
      }
}

double Pressure::load_power(const NodalState& s) const {
  double rate = 0;  // of the volume under the surface, m^3/s
  for (const Triangle& t : triangles_)
    rate += area_vector(s.x, t).dot(s.v.col(t[0]) + s.v.col(t[1]) + s.v.col(t[2])) / 3;
  return -pressure_ * factor_->value(s.t) * rate;
}

std::vector<double> Pressure::breakpoints(double start, double end) const {
  return times_between(factor_->kinks(), start, end);
}

namespace {

class PressureChoice : public TermChoice {
 public:
  static const Spec<PressureChoice>& spec() {
    using P = PressureChoice;
    static const auto s =
        Spec<P>()
            .key("surface", &P::surface_, "A named surface; default the whole outer surface.")
            .key("pressure", &P::pressure_, "Positive where it pushes on the body.", {.required = true, .unit = "Pa"})
            .key("factor", &P::factor_, "Factor in time.", {.fallback = "{type: constant}"});
    return s;
  }

  std::unique_ptr<Term> make(const Discretization& body) const override {
    return std::make_unique<Pressure>(surface_.value_or("the whole outer surface"),
                                      surface_or_all(body.mesh, surface_, origin), pressure_, factor_, body.pattern);
  }

  // Its stiffness changes with the shape; an open surface's work depends on the path.
  void declare(Traits& traits) const override {
    declare_load(*factor_, traits);
    traits.linear = traits.conservative = false;
  }

  Origin origin;

 private:
  std::optional<std::string> surface_;
  double pressure_ = 0;
  std::shared_ptr<const TimeFunction> factor_;
};

const bool pressure_registered = Registry<TermChoice>::add<PressureChoice>(
    "pressure", "Pressure on a surface that follows its motion; the symmetric part of its stiffness enters K.");

}  // namespace
}  // namespace orthodyn
