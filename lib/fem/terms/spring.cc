#include "lib/fem/terms/spring.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/errors.h"
#include "lib/fem/term_choice.h"
#include "lib/fem/terms/ends.h"

namespace orthodyn {

namespace {

struct Stretched {
  Vec3 span;          // m
  double length;      // m
  double elongation;  // l - l0, m
};

Stretched stretched(const SpringLink& link, const NodalVector& displacement) {
  const Vec3 D = link.at_rest, u = link.change(displacement), d = D + u;
  const double L = D.norm(), l = d.norm();
  const double change = L + l > 0 ? u.dot(2 * D + u) / (L + l) : 0;
  return {d, l, change + (L - link.free_length)};
}

// (l - l0)/l; 1 for a free length of zero.
double relative(const SpringLink& link, double elongation, double length) {
  if (link.free_length == 0) return 1;
  if (!(length > 0)) throw RecoverableError("a spring has shrunk to a point and has no direction");
  return elongation / length;
}

}  // namespace

std::string Springs::description() const { return fmt::format("{}: {} of {:.6g} N/m", name(), links_.size(), k_); }

void Springs::add_force(const NodalState& s, NodalVector& f) const {
  for (const SpringLink& link : links_) {
    const Stretched now = stretched(link, s.u);
    link.add_force(-k_ * relative(link, now.elongation, now.length) * now.span, f);
  }
}

void Springs::add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const {
  for (const SpringLink& link : links_) {
    const Stretched before = stretched(link, s0.u), after = stretched(link, s1.u);
    const double mean = relative(link, before.elongation + after.elongation, before.length + after.length);
    link.add_force(-k_ / 2 * mean * (before.span + after.span), f);
  }
}

void Springs::add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double*) const {
  for (const SpringLink& link : links_) {
    const auto [d, length, elongation] = stretched(link, s.u);
    double across = relative(link, elongation, length);  // negative under compression
    if (kind == TangentKind::gauss_newton) across = std::max(across, 0.0);
    Mat3 block = across * Mat3::Identity();
    if (link.free_length > 0) block += (1 - across) / (length * length) * d * d.transpose();
    link.add_block(k_ * block, pattern_, stiffness);
  }
}

double Springs::energy(const NodalState& s) const {
  double sum = 0;
  for (const SpringLink& link : links_) {
    const double elongation = stretched(link, s.u).elongation;
    sum += 0.5 * k_ * elongation * elongation;
  }
  return sum;
}

void Springs::add_stiffness_bound(Vector& row_sums) const {
  for (const SpringLink& link : links_) link.add_row_sum(k_, row_sums);
}

namespace {

class SpringChoice : public TermChoice, public Ends {
 public:
  static const Spec<SpringChoice>& spec() {
    using S = SpringChoice;
    static const auto s =
        ends_spec<S>()
            .key("stiffness", &S::stiffness_, "Total of all springs, shared evenly by the selected nodes.",
                 {.required = true, .unit = "N/m", .range = kPositive})
            .key("rest_length", &S::rest_length_, "Length without force; default that at rest.",
                 {.unit = "m", .range = kNonNegative})
            .check([](const S& spring, const Config& config) {
              spring.Ends::check(config);
              if (spring.in_place() && spring.rest_length_.value_or(0) > 0)
                config.at("rest_length").fail("has no direction: a node is tied to its own place; give an 'anchor'");
            });
    return s;
  }

  std::unique_ptr<Term> make(const Discretization& body) const override {
    std::vector<SpringLink> springs;
    for (const Link& link : links(body.mesh)) {
      const Vec3 at_rest = link.span(body.rest);
      const double free_length = rest_length_.value_or(at_rest.norm());
      if (at_rest.norm() == 0 && free_length > 0)
        origin.fail("a node lies on the anchor, so that its spring has no direction");
      springs.push_back({link, at_rest, free_length});
    }
    const double each = stiffness_ / static_cast<double>(springs.size());
    return std::make_unique<Springs>(each, std::move(springs), body.pattern);
  }

  NodePairs couplings(const TetMesh& mesh) const override { return Ends::couplings(mesh); }

  void declare(Traits& traits) const override {
    if (!in_place() && rest_length_ != 0.0) traits.linear = false;
  }

 private:
  double stiffness_ = 0;
  std::optional<double> rest_length_;
};

const bool spring_registered = Registry<TermChoice>::add<SpringChoice>(
    "spring",
    "Springs between two nodes, or from nodes to the ground: k (l - l0) along the spring, for any displacement.");

}  // namespace
}  // namespace orthodyn
