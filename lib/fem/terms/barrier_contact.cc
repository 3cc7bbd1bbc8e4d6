// Contact of two surfaces, or of a surface with itself, by a barrier: surfaces that never cross. A node at the distance
// r < g from the other surface has the energy k A g^2 B(r/g)/2, with its area A, the stiffness k (Pa/m), the gap g and
// the barrier B; two sharp edges have one, too, that fades where they become parallel. Both surfaces are treated alike,
// so that at the distance r the pressure is -k g B'(r/g). Forces are -grad of the energy: they have no resultant and no
// torque. States in which surfaces cross have no force, so that integrators shorten their steps.
// Source: Li et al. (2020), Incremental Potential Contact, ACM Trans. Graph. 39.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lib/core/limit_error.h"
#include "lib/fem/contact/barrier.h"
#include "lib/fem/contact/contact.h"
#include "lib/fem/contact/contact_input.h"
#include "lib/fem/contact/edge_weight.h"
#include "lib/fem/contact/friction.h"
#include "lib/fem/contact/near_features.h"
#include "lib/fem/contact/passing_time.h"
#include "lib/fem/contact/point_blocks.h"
#include "lib/fem/contact/remembered_places.h"
#include "lib/fem/surface.h"
#include "lib/fem/term_choice.h"

namespace orthodyn {
namespace {

// The largest distance at rest (m) of points of both surfaces that a place couples.
double farthest_apart(const NearPlace& place, const NodalVector& rest) {
  const std::size_t of_first = place.parallel > 0 ? 2 : 1;  // both ends of an edge, or a point
  double apart = 0;
  for (std::size_t i = 0; i < of_first; ++i)
    for (std::size_t j = of_first; j < 4; ++j)
      if (place.has_point(static_cast<int>(i)) && place.has_point(static_cast<int>(j)))
        apart = std::max(apart, (rest.col(place.points[i]) - rest.col(place.points[j])).norm());
  return apart;
}

struct BarrierLaw {
  double stiffness = 0;  // Pa/m
  double gap = 0;        // m
  Friction friction = {};
  std::optional<double> slide = {};  // m; the matrix has no entries of nodes that are farther apart at rest
  Contact::Label label = {};
};

class BarrierContact : public Term, public Contact {
 public:
  // `second` is empty for contact of a surface with itself. The pattern must outlive the term.
  BarrierContact(std::string name, const BarrierLaw& law, ContactSurface first, std::optional<ContactSurface> second,
                 const NodalVector& rest, const BlockPattern& pattern)
      : name_(std::move(name)),
        law_(law),
        first_(std::move(first)),
        second_(std::move(second)),
        near_(first_, second_ ? *second_ : first_, law.gap),
        middles_(second_ ? joined(first_, *second_) : first_.middles()),
        pattern_(pattern) {
    if (law.slide) rest_ = NodalVector(middles_.values(rest, rest_));
  }
  BarrierContact(const BarrierContact&) = delete;
  BarrierContact& operator=(const BarrierContact&) = delete;

  std::string name() const override { return name_; }
  std::string description() const override {
    return fmt::format("{}: {} points, {:.6g} Pa/m, gap {:.4g} m", name_,
                       first_.areas().size() + (second_ ? second_->areas().size() : 0), law_.stiffness, law_.gap);
  }
  std::size_t bytes() const override { return first_.bytes() + (second_ ? second_->bytes() : 0); }

  void add_force(const NodalState& s, NodalVector& f) const override {
    const PointState at(middles_, s, law_.friction.acts());
    const auto all = places(at.x);
    if (!all->empty()) note_action();
    for (const NearPlace& place : *all) {
      const EdgeWeight weight = weight_of(place);
      Vec3 force = pressing(place, weight) * place.distance.n;
      if (law_.friction.acts())
        force += law_.friction.force(relative_velocity(place.distance, place.points, at.v), place.distance.n,
                                     pressing(place, weight));
      add_pair_of_forces(middles_, place.distance, place.points, force, f);
      if (weight.slope == 0) continue;
      const Vec12 turn = -energy_of(place) * weight.slope * CrossProduct(place.distance.z).gradient;
      for (int k = 0; k < 4; ++k)
        add_force_at(middles_, place.points[static_cast<std::size_t>(k)], turn.segment<3>(3 * k), f);
    }
  }

  void add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double* damping) const override {
    const PointState at(middles_, s, law_.friction.acts());
    const auto all = places(at.x);
    for (const NearPlace& place : *all) {
      const EdgeWeight weight = weight_of(place);
      const Mat12 K = kind == TangentKind::exact ? exact(place, weight) : definite(place, weight);
      const auto add = [&](const auto& block, double* values) {
        add_blocks(pattern_, middles_, place, place.points, block, values);
      };
      add([&](int i, int j) { return K.block<3, 3>(3 * i, 3 * j); }, stiffness);
      if (!law_.friction.acts() || !damping) continue;
      const Eigen::Vector4d& share = place.distance.share;
      const Mat3 D = law_.friction.damping(relative_velocity(place.distance, place.points, at.v), place.distance.n,
                                           pressing(place, weight));
      add([&](int i, int j) { return share[i] * share[j] * D; }, damping);
    }
  }

  double dissipation(const NodalState& s) const override {
    if (!law_.friction.acts()) return 0;
    const PointState at(middles_, s, true);
    double sum = 0;
    const auto all = places(at.x);
    for (const NearPlace& place : *all) {
      const Vec3 velocity = relative_velocity(place.distance, place.points, at.v);
      sum -= velocity.dot(law_.friction.force(velocity, place.distance.n, pressing(place, weight_of(place))));
    }
    return sum;
  }

  bool has_mean_force() const override { return false; }

  EnergyKind energy_kind() const override { return EnergyKind::elastic; }

  double energy(const NodalState& s) const override {
    const PointState at(middles_, s, false);
    double sum = 0;
    const auto all = places(at.x);
    for (const NearPlace& place : *all) sum += weight_of(place).value * energy_of(place);
    return sum;
  }

  // An estimate: that of the penalty of contact with the stiffness at half of the gap.
  void add_stiffness_bound(Vector& row_sums) const override {
    const double k = law_.stiffness * barrier_curvature(0.5);
    const ContactSurface& second = second_ ? *second_ : first_;
    for (const auto& [own, other] : {std::pair(&first_, &second), std::pair(&second, &first_)})
      for (const auto& [point, area] : own->areas())
        middles_.for_each_node(point, [&, p = point, of_point = area, of_other = other](int node, double weight) {
          row_sums[node] +=
              k * std::abs(weight) * middles_.sum_of_weights(p) * (7 * of_point + largest_area(of_other->areas()));
        });
  }

  const Contact* contact() const override { return this; }
  bool refuses_crossing() const override { return true; }

  // Ten times the gap, so that rtol 1e-3 is a hundredth of it; for energies E below e = k A gap^2/2, the part
  // (E/e)^(1/3).
  double range(double energy) const override {
    const double area = std::max(largest_area(first_.areas()), second_ ? largest_area(second_->areas()) : 0);
    return 10 * law_.gap * std::min(1.0, std::cbrt(energy / (law_.stiffness * area * law_.gap * law_.gap / 2)));
  }

  const Label& label() const override { return law_.label; }
  bool has_resultant() const override { return second_.has_value(); }
  Vec3 resultant(const NodalState& s) const override { return force_on(first_, *this, s); }
  double largest_pressure(const NodalState& s) const override { return law_.stiffness * pressed_depth(s); }

  double pressed_depth(const NodalState& s) const override {
    const PointState at(middles_, s, false);
    double least = 1;
    const auto all = places(at.x);
    for (const NearPlace& place : *all) least = std::min(least, relative(place));
    return -law_.gap * barrier_slope(least);
  }

  // States in which surfaces cross are refused: a node may go half of the way through a body.
  double longest_step(const NodalState& s) const override {
    const ContactSurface& other = second_ ? *second_ : first_;
    const PointState at(middles_, s, true);
    return passing_time(first_, other, std::min(first_.thickness(), other.thickness()) / 2, at.x, at.v);
  }

 private:
  RememberedPlaces::Places places(const NodalVector& x) const {
    return remembered_.at(first_, second_ ? *second_ : first_, x, [&] { return found(x); });
  }

  std::vector<NearPlace> found(const NodalVector& x) const {
    constexpr double kLeast = 1e-8;
    std::vector<NearPlace> out;
    try {
      out = near_.at(x);
    } catch (const RecoverableError& e) {
      throw RecoverableError(fmt::format("{}: {}", name_, e.what()));
    }
    for (const NearPlace& place : out)
      if (relative(place) < kLeast)
        throw RecoverableError(fmt::format(
            "{}: surfaces are pressed together to {:.1g} of the gap: raise `stiffness` or `gap`", name_, kLeast));
    if (law_.slide)
      for (const NearPlace& place : out) require_near(place);
    return out;
  }

  void require_near(const NearPlace& place) const {
    if (const double apart = farthest_apart(place, rest_); apart > *law_.slide)
      throw LimitError(law_.label.place,
                       fmt::format("nodes that are {:.3g} m apart at rest touch, but `slide` is {:.3g} m: raise it",
                                   apart, *law_.slide));
  }

  static EdgeWeight weight_of(const NearPlace& place) {
    if (place.parallel == 0) return {};
    const auto& z = place.distance.z;
    return {Vec3(z.col(1) - z.col(0)).cross(Vec3(z.col(3) - z.col(2))).squaredNorm(), place.parallel};
  }
  double relative(const NearPlace& place) const { return place.distance.r / law_.gap; }
  // J, without the weight of edges
  double energy_of(const NearPlace& place) const {
    return law_.stiffness * place.area / 2 * law_.gap * law_.gap * barrier(relative(place));
  }
  // The force along the normal, N; negative for places that are counted too often.
  double pressing(const NearPlace& place, const EdgeWeight& weight) const {
    return -weight.value * law_.stiffness * place.area / 2 * law_.gap * barrier_slope(relative(place));
  }

  // Without the second derivatives of the distance and of the weight of edges. Places that are counted too often are
  // left out, so that it is too stiff in notches.
  Mat12 definite(const NearPlace& place, const EdgeWeight& weight) const {
    if (place.area < 0) return Mat12::Zero();
    const Vec12 slope = place.distance.gradient();
    return weight.value * law_.stiffness * place.area / 2 * barrier_curvature(relative(place)) * slope *
           slope.transpose();
  }

  Mat12 exact(const NearPlace& place, const EdgeWeight& weight) const {
    const double k = law_.stiffness * place.area / 2, s = relative(place);
    const Vec12 slope = place.distance.gradient();
    Mat12 K =
        weight.value * k *
        (barrier_curvature(s) * slope * slope.transpose() + barrier_slope(s) / s * place.distance.second_derivative());
    if (weight.slope == 0) return K;
    const CrossProduct c(place.distance.z);
    const Mat12 mixed = c.gradient * slope.transpose();
    K += energy_of(place) * (weight.curvature * c.gradient * c.gradient.transpose() + weight.slope * c.curvature) +
         weight.slope * k * law_.gap * barrier_slope(s) * (mixed + mixed.transpose());
    return K;
  }

  std::string name_;
  BarrierLaw law_;
  ContactSurface first_;
  std::optional<ContactSurface> second_;
  NearFeatures near_;
  FaceMiddles middles_;
  RememberedPlaces remembered_;
  NodalVector rest_;  // m; empty without `slide`
  const BlockPattern& pattern_;
};

class BarrierContactChoice : public TermChoice {
 public:
  static const Spec<BarrierContactChoice>& spec() {
    using C = BarrierContactChoice;
    static const auto s = with_contact_keys(
        Spec<C>()
            .key("between", &C::between_,
                 "Two surfaces that can touch, or twice the same surface for contact with itself; a region stands for "
                 "its whole outer surface.",
                 {.required = true})
            .key("stiffness", &C::stiffness_,
                 "Pressure per distance: at half of the gap, the pressure is twice the stiffness times the gap. It "
                 "grows "
                 "without limit where surfaces get nearer.",
                 {.required = true, .unit = "Pa/m", .range = kPositive})
            .key("gap", &C::gap_,
                 "Distance at which contact sets in; default a twentieth of the mean cell edge, at most half of the "
                 "least "
                 "distance at rest.",
                 {.unit = "m", .range = kPositive})
            .key("slide", &C::slide_,
                 "Largest distance at rest of nodes that touch later, with all nodes of the faces that they touch. It "
                 "saves memory; a run stops where it is too small. Default: no limit.",
                 {.unit = "m", .range = kPositive}),
        &C::friction_, &C::creep_, &C::name_);
    return s;
  }

  std::unique_ptr<Term> make(const Discretization& body) const override {
    ContactSurface first = contact_surface(body.mesh, between_[0], origin);
    std::optional<ContactSurface> second;
    if (!is_of_one()) {
      second = contact_surface(body.mesh, between_[1], origin, first.middles().end());
      require_apart(first, *second, between_, origin);
    }
    const BarrierLaw law{.stiffness = stiffness_,
                         .gap = allowed_gap(first, second ? *second : first, body.rest),
                         .friction = {friction_, creep_},
                         .slide = slide_,
                         .label = {name_, origin.where}};
    const std::string name = is_of_one() ? fmt::format("barrier contact of {} with itself", between_[0])
                                         : fmt::format("barrier contact of {} and {}", between_[0], between_[1]);
    return std::make_unique<BarrierContact>(name, law, std::move(first), std::move(second), body.rest, body.pattern);
  }

  NodePairs couplings(const Mesh& mesh) const override {
    const ContactSurface first = contact_surface(mesh, between_[0], origin);
    if (is_of_one()) return contact_couplings(mesh, first, first, slide_, origin);
    return contact_couplings(mesh, first, contact_surface(mesh, between_[1], origin, first.middles().end()), slide_,
                             origin);
  }

  void declare(Traits& traits) const override {
    traits.linear = traits.smooth = false;
    Friction{friction_, creep_}.declare(traits);
  }

  SourceLocation origin;

 private:
  bool is_of_one() const { return between_[0] == between_[1]; }

  // The gap, m. The surfaces must not cross or touch at rest, and those of one body must be farther apart than the gap.
  double allowed_gap(const ContactSurface& first, const ContactSurface& second, const NodalVector& nodes) const {
    NodalVector storage;
    const NodalVector& rest = (is_of_one() ? first.middles() : joined(first, second)).values(nodes, storage);
    constexpr double kOfEdge = 0.05;
    const double usual = kOfEdge * std::min(first.mean_edge(), second.mean_edge());
    const double searched = gap_.value_or(2 * usual);
    double least = std::numeric_limits<double>::infinity();
    try {
      for (const NearPlace& place : NearFeatures(first, second, searched).at(rest)) {
        least = std::min(least, place.distance.r);
        require_slide(place, rest);
      }
    } catch (const RecoverableError& e) {
      origin.fail(
          fmt::format("{} at rest: this contact needs surfaces that are about a gap apart, {:.3g} m here; move one of "
                      "them, or use the type contact",
                      e.what(), gap_.value_or(usual)));
    }
    constexpr double kTouching = 1e-3;
    if (least < kTouching * std::min(usual, searched))
      origin.fail(
          fmt::format("the surfaces are {:.2g} m apart at rest, next to touching: this contact needs surfaces "
                      "that are about a gap apart; move one of them, or use the type contact",
                      least));
    if (!gap_) return std::min(usual, least / 2);
    if (is_of_one() && least < *gap_)
      origin.fail(fmt::format(
          "parts of '{}' are {:.3g} m apart at rest (the thickness of a sheet counts), less than the gap of {:.3g} "
          "m; choose a smaller gap",
          between_[0], least, *gap_));
    return *gap_;
  }

  void require_slide(const NearPlace& place, const NodalVector& rest) const {
    if (const double apart = farthest_apart(place, rest); slide_ && apart > *slide_)
      origin.fail(fmt::format("nodes that are {:.3g} m apart are near each other at rest: raise `slide`", apart));
  }

  std::array<std::string, 2> between_;
  std::string name_;
  double stiffness_ = 0, friction_ = 0, creep_ = Friction().creep;
  std::optional<double> gap_, slide_;
};

const bool barrier_contact_registered = Registry<TermChoice>::add<BarrierContactChoice>(
    "barrier_contact",
    "Two surfaces, or a surface and itself, that never cross: a barrier before they touch, also between edges, with or "
    "without friction.");

}  // namespace
}  // namespace orthodyn
