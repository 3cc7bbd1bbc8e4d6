#include "lib/fem/terms/ground_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/fem/surface.h"
#include "lib/fem/term_choice.h"
#include "lib/mesh/selection.h"

namespace orthodyn {

namespace {

// psi(d) and its derivatives.
double penalty(double d, double w) { return d <= 0 ? 0 : d < w ? d * d * d / (6 * w) : d * (d - w) / 2 + w * w / 6; }
double slope(double d, double w) { return d <= 0 ? 0 : d < w ? d * d / (2 * w) : d - w / 2; }
double curvature(double d, double w) { return d <= 0 ? 0 : d < w ? d / w : 1; }

// The mean of psi' from a to b. Simpson's rule is exact where psi' is one polynomial, and serves over a way so short
// that the quotient would have no digits.
double mean_slope(double a, double b, double w) {
  const bool one_piece = std::max(a, b) <= 0 || std::min(a, b) >= w || (std::min(a, b) >= 0 && std::max(a, b) <= w);
  if (one_piece || std::abs(b - a) < 1e-6 * w) return (slope(a, w) + 4 * slope((a + b) / 2, w) + slope(b, w)) / 6;
  return (penalty(b, w) - penalty(a, w)) / (b - a);
}

}  // namespace

std::string GroundContact::description() const {
  return fmt::format("{}: {} nodes, {:.6g} Pa/m", name(), areas_.size(), plane_.stiffness);
}

void GroundContact::add_force(const NodalState& s, NodalVector& f) const {
  for (const auto& [node, area] : areas_)
    if (const double d = depth(node, s.x); d > 0)
      f.col(node) += plane_.stiffness * area * slope(d, plane_.onset) * plane_.normal;
}

void GroundContact::add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const {
  for (const auto& [node, area] : areas_) {
    const double mean = mean_slope(depth(node, s0.x), depth(node, s1.x), plane_.onset);
    if (mean > 0) f.col(node) += plane_.stiffness * area * mean * plane_.normal;
  }
}

void GroundContact::add_tangent(const NodalState& s, TangentKind, double* stiffness, double*) const {
  const Mat3 across = plane_.stiffness * plane_.normal * plane_.normal.transpose();
  for (const auto& [node, area] : areas_)
    if (const double d = depth(node, s.x); d > 0)
      pattern_.add(node, node, pattern_.offset(node, node), area * curvature(d, plane_.onset) * across, stiffness);
}

double GroundContact::energy(const NodalState& s) const {
  double sum = 0;
  for (const auto& [node, area] : areas_) sum += area * penalty(depth(node, s.x), plane_.onset);
  return plane_.stiffness * sum;
}

void GroundContact::add_stiffness_bound(Vector& row_sums) const {
  for (const auto& [node, area] : areas_) row_sums[node] += plane_.stiffness * area;
}

double GroundContact::contact_stiffness() const {
  double largest = 0;
  for (const auto& [node, area] : areas_) largest = std::max(largest, area);
  return plane_.stiffness * largest;
}

namespace {

constexpr double kUsualOnset = 1e-3;  // of the mesh's diagonal

class GroundContactChoice : public TermChoice {
 public:
  static const Spec<GroundContactChoice>& spec() {
    using G = GroundContactChoice;
    static const auto s =
        Spec<G>()
            .key("point", &G::point_, "A point of the plane.", {.unit = "m"})
            .key("normal", &G::normal_, "Away from the ground, of any length.")
            .key("stiffness", &G::stiffness_, "Pressure per depth.",
                 {.required = true, .unit = "Pa/m", .range = kPositive})
            .key("onset", &G::onset_, "Depth over which contact sets in; default 1e-3 of the mesh's diagonal.",
                 {.unit = "m", .range = kPositive})
            .key("surface", &G::surface_, "Which surface can touch it: a named one; default the whole outer surface.")
            .check([](const G& ground, const Config& config) {
              if (ground.normal_.norm() == 0) config.at("normal").fail("is zero; give a direction");
            });
    return s;
  }

  std::unique_ptr<Term> make(const Discretization& body) const override {
    const auto triangles = surface_or_all(body.mesh, surface_, origin);
    const double onset = onset_.value_or(kUsualOnset * bounding_box(body.mesh).diagonal());
    return std::make_unique<GroundContact>(GroundPlane{point_, normal_.normalized(), stiffness_, onset},
                                           node_areas(body.mesh, triangles), body.pattern);
  }

  void declare(Traits& traits) const override { traits.linear = traits.smooth = false; }

  SourceLocation origin;

 private:
  Vec3 point_ = Vec3::Zero(), normal_{0, 0, 1};
  double stiffness_ = 0;
  std::optional<double> onset_;
  std::optional<std::string> surface_;
};

const bool ground_contact_registered = Registry<TermChoice>::add<GroundContactChoice>(
    "ground_contact", "A rigid plane that pushes back what is below it, by a smooth penalty; no friction, no damping.");
const bool ground_renamed = Registry<TermChoice>::rename("ground", "ground_contact");

}  // namespace
}  // namespace orthodyn
