#include "lib/fem/terms/spring.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/errors.h"
#include "lib/fem/term_choice.h"
#include "lib/fem/terms/ends.h"

namespace orthodyn {

namespace {

// l0/l; 0 for a rest length of zero.
double contraction(const SpringLink& link, double length) {
  if (link.rest_length == 0) return 0;
  if (!(length > 0)) throw RecoverableError("a spring has shrunk to a point and has no direction");
  return link.rest_length / length;
}

}  // namespace

std::string Springs::description() const { return fmt::format("{}: {} of {:.6g} N/m", name(), links_.size(), k_); }

void Springs::add_force(const NodalState& s, NodalVector& f) const {
  for (const SpringLink& link : links_) {
    const Vec3 d = link.span(s.x);
    link.add_force(-k_ * (1 - contraction(link, d.norm())) * d, f);
  }
}

void Springs::add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const {
  for (const SpringLink& link : links_) {
    const Vec3 d0 = link.span(s0.x), d1 = link.span(s1.x);
    link.add_force(-k_ / 2 * (1 - contraction(link, (d0.norm() + d1.norm()) / 2)) * (d0 + d1), f);
  }
}

void Springs::add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double*) const {
  for (const SpringLink& link : links_) {
    const Vec3 d = link.span(s.x);
    const double c = contraction(link, d.norm());
    double across = 1 - c;  // negative under compression
    if (kind == TangentKind::gauss_newton) across = std::max(across, 0.0);
    Mat3 block = across * Mat3::Identity();
    if (c > 0) block += (1 - across) / d.squaredNorm() * d * d.transpose();
    link.add_block(k_ * block, pattern_, stiffness);
  }
}

double Springs::energy(const NodalState& s) const {
  double sum = 0;
  for (const SpringLink& link : links_) {
    const double stretch = link.span(s.x).norm() - link.rest_length;
    sum += 0.5 * k_ * stretch * stretch;
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
            .key("stiffness", &S::stiffness_, "Of all springs together, shared evenly by the selected nodes.",
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
      const double length = link.span(body.rest).norm();
      const double rest_length = rest_length_.value_or(length);
      if (length == 0 && rest_length > 0) origin.fail("a node lies on the anchor, so that its spring has no direction");
      springs.push_back({link, rest_length});
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
