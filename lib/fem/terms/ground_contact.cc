// Contact with a rigid plane by a smooth penalty, with or without friction (lib/fem/contact/friction.h). A point
// (face_middles.h) at position x has the depth d = (point - x) . n below the plane with normal n. With its surface area
// A and the stiffness k (Pa/m), its energy is k A psi(d) (lib/fem/contact/penalty.h). The force is k A psi'(d) n, the
// stiffness k A psi''(d) n n^T. The contact stiffness builds up over the depth w. The mean force between two states
// takes the mean of psi' over the depths between them. Without damping, the plane returns all energy.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/fem/block_pattern.h"
#include "lib/fem/contact/contact.h"
#include "lib/fem/contact/friction.h"
#include "lib/fem/contact/penalty.h"
#include "lib/fem/contact/point_blocks.h"
#include "lib/fem/surface.h"
#include "lib/fem/term_choice.h"
#include "lib/mesh/selection.h"

namespace orthodyn {
namespace {

struct GroundPlane {
  Vec3 point = Vec3::Zero(), normal{0, 0, 1};  // m; unit vector away from the ground
  double stiffness = 0;                        // Pa/m
  double onset = 0;                            // w, m
  Friction friction = {};
  Contact::Label label = {};
};

// Mean of psi' over [a, b]. Simpson's rule is exact if psi' is a single polynomial in [a, b]. It also replaces the
// difference quotient for short intervals, where the quotient has large round-off.
double mean_slope(double a, double b, double w) {
  const bool one_piece = std::max(a, b) <= 0 || std::min(a, b) >= w || (std::min(a, b) >= 0 && std::max(a, b) <= w);
  if (one_piece || std::abs(b - a) < 1e-6 * w)
    return (penalty_slope(a, w) + 4 * penalty_slope((a + b) / 2, w) + penalty_slope(b, w)) / 6;
  return (penalty(b, w) - penalty(a, w)) / (b - a);
}

class GroundContact : public Term, public Contact {
 public:
  // `areas`: pairs of a point and its surface area (m^2). The pattern must outlive the term.
  GroundContact(const GroundPlane& plane, std::vector<std::pair<int, double>> areas, FaceMiddles middles,
                const BlockPattern& pattern)
      : plane_(plane), areas_(std::move(areas)), middles_(std::move(middles)), pattern_(pattern) {}

  std::string name() const override { return "ground"; }

  std::string description() const override {
    return fmt::format("{}: {} points, {:.6g} Pa/m", name(), areas_.size(), plane_.stiffness);
  }

  std::unique_ptr<Term> part(const Subdomain& subdomain) const override {
    FaceMiddles middles(subdomain.num_nodes());
    auto areas = contact_areas_of(subdomain, areas_, middles_, middles);
    return std::make_unique<GroundContact>(plane_, std::move(areas), std::move(middles), pattern_);
  }
  std::size_t bytes() const override { return areas_.capacity() * sizeof(areas_[0]); }

  void add_force(const NodalState& s, NodalVector& f) const override {
    const PointState at(middles_, s, plane_.friction.acts());
    for_each_touch(at.x, [&](int point, double d, double area) {
      Vec3 force = pressing(d, area) * plane_.normal;
      if (plane_.friction.acts()) force += plane_.friction.force(at.v.col(point), plane_.normal, pressing(d, area));
      add_force_at(middles_, point, force, f);
      note_action();
    });
  }

  double dissipation(const NodalState& s) const override {
    if (!plane_.friction.acts()) return 0;
    const PointState at(middles_, s, true);
    double sum = 0;
    for_each_touch(at.x, [&](int point, double d, double area) {
      const Vec3 velocity = at.v.col(point);
      sum -= velocity.dot(plane_.friction.force(velocity, plane_.normal, pressing(d, area)));
    });
    return sum;
  }

  void add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const override {
    const PointState at0(middles_, s0, false), at1(middles_, s1, false);
    for (const auto& [point, area] : areas_) {
      const double mean = mean_slope(depth(point, at0.x), depth(point, at1.x), plane_.onset);
      if (mean <= 0) continue;
      add_force_at(middles_, point, plane_.stiffness * area * mean * plane_.normal, f);
      note_action();
    }
  }

  void add_tangent(const NodalState& s, TangentKind, double* stiffness, double* damping) const override {
    const PointState at(middles_, s, plane_.friction.acts());
    const Mat3 across = plane_.stiffness * plane_.normal * plane_.normal.transpose();
    for_each_touch(at.x, [&](int point, double d, double area) {
      add_block_at(pattern_, middles_, point, point, area * penalty_curvature(d, plane_.onset) * across, stiffness);
      if (!plane_.friction.acts() || !damping) return;
      add_block_at(pattern_, middles_, point, point,
                   plane_.friction.damping(at.v.col(point), plane_.normal, pressing(d, area)), damping);
    });
  }

  EnergyKind energy_kind() const override { return EnergyKind::elastic; }

  double energy(const NodalState& s) const override {
    const PointState at(middles_, s, false);
    double sum = 0;
    for_each_touch(at.x, [&](int, double d, double area) { sum += area * penalty(d, plane_.onset); });
    return plane_.stiffness * sum;
  }

  void add_stiffness_bound(Vector& row_sums) const override {
    for (const auto& [point, area] : areas_)
      middles_.for_each_node(point, [&, p = point, of_point = area](int node, double weight) {
        row_sums[node] += plane_.stiffness * of_point * std::abs(weight) * middles_.sum_of_weights(p);
      });
  }

  const Contact* contact() const override { return this; }

  const Label& label() const override { return plane_.label; }
  Vec3 resultant(const NodalState& s) const override {
    NodalVector f = NodalVector::Zero(3, s.x.cols());
    add_force(s, f);
    return f.rowwise().sum();
  }
  double largest_pressure(const NodalState& s) const override {
    const PointState at(middles_, s, false);
    double deepest = 0;
    for_each_touch(at.x, [&](int, double d, double) { deepest = std::max(deepest, d); });
    return plane_.stiffness * penalty_slope(deepest, plane_.onset);
  }

  double range(double energy) const override { return penalty_depth(energy, plane_.stiffness * largest_area(areas_)); }

 private:
  // visit(point, depth, area) of the points below the plane
  template <class Visit>
  void for_each_touch(const NodalVector& x, Visit&& visit) const {
    for (const auto& [point, area] : areas_)
      if (const double d = depth(point, x); d > 0) visit(point, d, area);
  }
  // Normal force of a point, N.
  double pressing(double d, double area) const { return plane_.stiffness * area * penalty_slope(d, plane_.onset); }
  double depth(int point, const NodalVector& x) const { return plane_.normal.dot(plane_.point - x.col(point)); }

  GroundPlane plane_;
  std::vector<std::pair<int, double>> areas_;
  FaceMiddles middles_;
  const BlockPattern& pattern_;
};

constexpr double kUsualOnset = 1e-3;  // default onset, relative to the mesh's diagonal

class GroundContactChoice : public TermChoice {
 public:
  static const Spec<GroundContactChoice>& spec() {
    using G = GroundContactChoice;
    static const auto s = with_contact_keys(
        Spec<G>()
            .key("point", &G::point_, "A point of the plane.", {.unit = "m"})
            .key("normal", &G::normal_, "Away from the ground, of any length.")
            .key("stiffness", &G::stiffness_, "Pressure per depth.",
                 {.required = true, .unit = "Pa/m", .range = kPositive})
            .key("onset", &G::onset_, "Depth over which contact sets in; default 1e-3 of the mesh's diagonal.",
                 {.unit = "m", .range = kPositive})
            .key("surface", &G::surface_, "The surface that can touch the plane; default the whole outer surface.")
            .check([](const G& ground, const Config& config) {
              if (ground.normal_.norm() == 0) config.at("normal").fail("is zero; give a direction");
            }),
        &G::friction_, &G::creep_, &G::name_);
    return s;
  }

  std::unique_ptr<Term> make(const Discretization& body) const override {
    const auto faces = surface_or_all(body.mesh, surface_, origin);
    const double onset = onset_.value_or(kUsualOnset * bounding_box(body.mesh).diagonal());
    FaceMiddles middles(static_cast<int>(body.mesh.nodes.size()));
    auto areas = contact_areas(body.mesh, faces, middles);
    return std::make_unique<GroundContact>(
        GroundPlane{point_, normal_.normalized(), stiffness_, onset, {friction_, creep_}, {name_, origin.where}},
        std::move(areas), std::move(middles), body.pattern);
  }

  void declare(Traits& traits) const override {
    traits.linear = traits.smooth = false;
    Friction{friction_, creep_}.declare(traits);
  }

  SourceLocation origin;

 private:
  Vec3 point_ = Vec3::Zero(), normal_{0, 0, 1};
  double stiffness_ = 0, friction_ = 0, creep_ = Friction().creep;
  std::optional<double> onset_;
  std::optional<std::string> surface_;
  std::string name_;
};

const bool ground_contact_registered = Registry<TermChoice>::add<GroundContactChoice>(
    "ground_contact",
    "A rigid plane that pushes back the parts of the body below it, by a smooth penalty, with or without friction.");
const bool ground_renamed = Registry<TermChoice>::rename("ground", "ground_contact");

}  // namespace
}  // namespace orthodyn
