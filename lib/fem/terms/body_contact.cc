// Contact of two surfaces by a smooth penalty. A node of one surface at the depth d below the other one
// has the energy k A psi(d) / 2, with the node's area A, the stiffness k (Pa/m) and the function psi of penalty.h. Both
// surfaces are treated alike, so that at the depth d the pressure is k psi'(d). The depth is the distance of the
// nearest point of the other surface in its present shape. Forces are -grad of the energy: they have no resultant and
// no torque.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "lib/core/limit_error.h"
#include "lib/fem/contact/contact.h"
#include "lib/fem/contact/contact_input.h"
#include "lib/fem/contact/friction.h"
#include "lib/fem/contact/passing_time.h"
#include "lib/fem/contact/penalty.h"
#include "lib/fem/contact/point_blocks.h"
#include "lib/fem/surface.h"
#include "lib/fem/term_choice.h"

namespace orthodyn {
namespace {

struct ContactLaw {
  double stiffness = 0;  // Pa/m
  double onset = 0;      // m
  double reach = 0;      // m; deeper nodes are not in contact
  Friction friction = {};
  std::optional<double> slide = {};  // m; the matrix has no entries of nodes that are farther apart at rest
  Contact::Label label = {};
};

class BodyContact : public Term, public Contact {
 public:
  // The pattern must outlive the term.
  BodyContact(std::string name, const ContactLaw& law, ContactSurface first, ContactSurface second,
              const NodalVector& rest, const BlockPattern& pattern)
      : name_(std::move(name)),
        law_(law),
        first_(std::move(first)),
        second_(std::move(second)),
        middles_(joined(first_, second_)),
        pattern_(pattern) {
    if (law.slide) rest_ = NodalVector(middles_.values(rest, rest_));
  }

  std::string name() const override { return name_; }
  std::string description() const override {
    return fmt::format("{}: {} and {} points, {:.6g} Pa/m", name_, first_.areas().size(), second_.areas().size(),
                       law_.stiffness);
  }
  std::size_t bytes() const override { return first_.bytes() + second_.bytes(); }

  void add_force(const NodalState& s, NodalVector& f) const override {
    const PointState at(middles_, s, law_.friction.acts());
    for_each_touch(at.x, [&](const Touch& touch, double stiffness) {
      const Distance& distance = touch.distance;
      Vec3 force = -pressing(touch, stiffness) * distance.n;
      if (law_.friction.acts())
        force += law_.friction.force(relative_velocity(distance, touch.points(), at.v), distance.n,
                                     pressing(touch, stiffness));
      add_pair_of_forces(middles_, distance, touch.points(), force, f);
      note_action();
    });
  }

  // TangentKind::gauss_newton leaves out the second derivative of the distance.
  void add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double* damping) const override {
    const PointState at(middles_, s, law_.friction.acts());
    for_each_touch(at.x, [&](const Touch& touch, double k) {
      const double d = touch.distance.r;
      const Vec12 slope = touch.distance.gradient();
      Mat12 K = k * penalty_curvature(d, law_.onset) * slope * slope.transpose();
      if (kind == TangentKind::exact) K += k * penalty_slope(d, law_.onset) / d * touch.distance.second_derivative();
      const FourPoints points = touch.points();
      add_blocks(
          pattern_, middles_, touch.distance, points, [&](int i, int j) { return K.block<3, 3>(3 * i, 3 * j); },
          stiffness);
      if (!law_.friction.acts() || !damping) return;
      const Eigen::Vector4d& share = touch.distance.share;
      const Mat3 D =
          law_.friction.damping(relative_velocity(touch.distance, points, at.v), touch.distance.n, pressing(touch, k));
      add_blocks(
          pattern_, middles_, touch.distance, points, [&](int i, int j) { return share[i] * share[j] * D; }, damping);
    });
  }

  double dissipation(const NodalState& s) const override {
    if (!law_.friction.acts()) return 0;
    const PointState at(middles_, s, true);
    double sum = 0;
    for_each_touch(at.x, [&](const Touch& touch, double k) {
      const Vec3 velocity = relative_velocity(touch.distance, touch.points(), at.v);
      sum -= velocity.dot(law_.friction.force(velocity, touch.distance.n, pressing(touch, k)));
    });
    return sum;
  }

  bool has_mean_force() const override { return false; }

  EnergyKind energy_kind() const override { return EnergyKind::elastic; }

  double energy(const NodalState& s) const override {
    const PointState at(middles_, s, false);
    double sum = 0;
    for_each_touch(at.x, [&](const Touch& touch, double k) { sum += k * penalty(touch.distance.r, law_.onset); });
    return sum;
  }

  // An estimate. A point in contact has the row sum 2 k A/2, with its area A. The corner of a triangle has the row sums
  // of the nodes that press on the triangles at the corner: their area is at most about six times the area of the
  // corner, or the largest area of one node.
  void add_stiffness_bound(Vector& row_sums) const override {
    for (const auto& [own, other] : {std::pair(&first_, &second_), std::pair(&second_, &first_)}) {
      const double largest = largest_area(other->areas());
      for (const auto& [point, area] : own->areas())
        middles_.for_each_node(point, [&, p = point, of_point = area](int node, double weight) {
          row_sums[node] += law_.stiffness * std::abs(weight) * middles_.sum_of_weights(p) * (7 * of_point + largest);
        });
    }
  }

  const Contact* contact() const override { return this; }

  double range(double energy) const override {
    return penalty_depth(energy,
                         law_.stiffness * std::max(largest_area(first_.areas()), largest_area(second_.areas())));
  }

  const Label& label() const override { return law_.label; }
  Vec3 resultant(const NodalState& s) const override { return force_on(first_, *this, s); }
  double largest_pressure(const NodalState& s) const override { return law_.stiffness * pressed_depth(s); }

  double pressed_depth(const NodalState& s) const override {
    const PointState at(middles_, s, false);
    double deepest = 0;
    for_each_touch(at.x, [&](const Touch& touch, double) { deepest = std::max(deepest, touch.distance.r); });
    return penalty_slope(deepest, law_.onset);
  }

  double longest_step(const NodalState& s) const override {
    const PointState at(middles_, s, true);
    return passing_time(first_, second_, std::min({law_.reach, first_.thickness() / 2, second_.thickness() / 2}), at.x,
                        at.v);
  }

 private:
  // The normal force of a touch of the stiffness k A / 2, N.
  double pressing(const Touch& touch, double stiffness) const {
    return stiffness * penalty_slope(touch.distance.r, law_.onset);
  }

  // visit(touch, k A / 2), at the positions x of all points
  template <class Visit>
  void for_each_touch(const NodalVector& x, Visit&& visit) const {
    for (const auto& [own, other] : {std::pair(&first_, &second_), std::pair(&second_, &first_)}) {
      const PlacedSurface placed(*other, x, law_.reach);
      for (const auto& [point, area] : own->areas())
        if (const auto touch = placed.touch_of(point)) {
          require_near(*touch);
          visit(*touch, law_.stiffness * area / 2);
        }
    }
  }

  void require_near(const Touch& touch) const {
    if (!law_.slide) return;
    for (const int corner : touch.triangle)
      if (const double apart = (rest_.col(corner) - rest_.col(touch.point)).norm(); apart > *law_.slide)
        throw LimitError(law_.label.place,
                         fmt::format("nodes that are {:.3g} m apart at rest touch, but `slide` is {:.3g} m: raise it",
                                     apart, *law_.slide));
  }

  std::string name_;
  ContactLaw law_;
  ContactSurface first_, second_;
  FaceMiddles middles_;
  NodalVector rest_;  // m; empty without `slide`
  const BlockPattern& pattern_;
};

class BodyContactChoice : public TermChoice {
 public:
  static const Spec<BodyContactChoice>& spec() {
    using C = BodyContactChoice;
    static const auto s = with_contact_keys(
        Spec<C>()
            .key("between", &C::between_, "Two surfaces that can touch; a region stands for its whole outer surface.",
                 {.required = true})
            .key("stiffness", &C::stiffness_,
                 "Pressure per depth; about Young's modulus over the size of a cell. The depth under the pressure p is "
                 "p over the stiffness, plus half of the onset.",
                 {.required = true, .unit = "Pa/m", .range = kPositive})
            .key("onset", &C::onset_, "Depth over which contact sets in; default a hundredth of the mean cell edge.",
                 {.unit = "m", .range = kPositive})
            .key("reach", &C::reach_,
                 "Largest depth of a node that is in contact; default half the mean cell edge. A node that gets deeper "
                 "in "
                 "one step passes through: keep it below half the thickness of thin bodies.",
                 {.unit = "m", .range = kPositive})
            .key("slide", &C::slide_,
                 "Largest distance at rest of nodes that touch later, with the corners of the face that they touch. It "
                 "saves "
                 "memory; a run stops where it is too small. Default: no limit.",
                 {.unit = "m", .range = kPositive})
            .check([](const C& contact, const Config& config) {
              if (contact.between_[0] == contact.between_[1])
                config.at("between").fail(
                    "names one surface twice; contact of a surface with itself needs the type barrier_contact");
            }),
        &C::friction_, &C::creep_, &C::name_);
    return s;
  }

  std::unique_ptr<Term> make(const Discretization& body) const override {
    ContactSurface first = surface(body.mesh, 0), second = surface(body.mesh, 1, first.middles().end());
    require_apart(first, second, between_, origin);
    const double edge = std::min(first.mean_edge(), second.mean_edge());
    const ContactLaw law{.stiffness = stiffness_,
                         .onset = onset_.value_or(0.01 * edge),
                         .reach = reach_.value_or(0.5 * edge),
                         .friction = {friction_, creep_},
                         .slide = slide_,
                         .label = {name_, origin.where}};
    return std::make_unique<BodyContact>(fmt::format("contact of {} and {}", between_[0], between_[1]), law,
                                         std::move(first), std::move(second), body.rest, body.pattern);
  }

  NodePairs couplings(const Mesh& mesh) const override {
    const ContactSurface first = surface(mesh, 0);
    return contact_couplings(mesh, first, surface(mesh, 1, first.middles().end()), slide_, origin);
  }

  void declare(Traits& traits) const override {
    traits.linear = traits.smooth = false;
    Friction{friction_, creep_}.declare(traits);
  }

  SourceLocation origin;

 private:
  ContactSurface surface(const Mesh& mesh, std::size_t k, std::optional<int> first_middle = {}) const {
    return contact_surface(mesh, between_[k], origin, first_middle);
  }

  std::array<std::string, 2> between_;
  std::string name_;
  double stiffness_ = 0, friction_ = 0, creep_ = Friction().creep;
  std::optional<double> onset_, reach_, slide_;
};

const bool body_contact_registered = Registry<TermChoice>::add<BodyContactChoice>(
    "contact", "Two surfaces of bodies that push each other back, by a smooth penalty, with or without friction.");

}  // namespace
}  // namespace orthodyn
