// Springs along their links, for any displacement. A spring of stiffness k with span d, length l = |d|, free length l0
// and direction n = d/l has
//   energy k (l - l0)^2/2,  force on node a -k (l - l0) n,
//   stiffness k n n^T + k (1 - l0/l) (I - n n^T).
// The mean force between states 1 and 2 is -k (1 - 2 l0/(l_1 + l_2)) (d_1 + d_2)/2. Its work equals the change of
// energy, because it is the discrete derivative with respect to l^2 (Gonzalez 1996). With the span D at rest, L = |D|
// and the change u of the span, the elongation is l - l0 = (L - l0) + (2 D + u) . u / (L + l), which is accurate for
// small u. A free length of zero gives the linear force -k d. Any other spring has no direction at length zero and
// throws RecoverableError.
#include <fmt/format.h>

#include <algorithm>

#include "lib/core/errors.h"
#include "lib/fem/term_choice.h"
#include "lib/fem/terms/link.h"

namespace orthodyn {
namespace {

struct SpringLink : Link {
  Vec3 at_rest = Vec3::Zero();  // span D in the rest shape, m
  double free_length = 0;       // length l0 without force, m
};

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

// Returns (l - l0)/l; 1 for a free length of zero.
double relative(const SpringLink& link, double elongation, double length) {
  if (link.free_length == 0) return 1;
  if (!(length > 0)) throw RecoverableError("a spring has zero length and no direction");
  return elongation / length;
}

class Springs : public Term {
 public:
  // `stiffness` of each spring (N/m). The pattern must outlive the term and couple the ends.
  Springs(double stiffness, std::vector<SpringLink> links, const BlockPattern& pattern)
      : k_(stiffness), links_(std::move(links)), pattern_(pattern) {}

  std::string name() const override { return "springs"; }
  std::string description() const override { return fmt::format("{}: {} of {:.6g} N/m", name(), links_.size(), k_); }
  std::unique_ptr<Term> part(const Subdomain& subdomain) const override {
    return std::make_unique<Springs>(k_, owned_links(links_, subdomain), pattern_);
  }
  std::size_t bytes() const override { return links_.capacity() * sizeof(SpringLink); }

  void add_force(const NodalState& s, NodalVector& f) const override {
    for (const SpringLink& link : links_) {
      const Stretched now = stretched(link, s.u);
      link.add_force(-k_ * relative(link, now.elongation, now.length) * now.span, f);
    }
  }

  void add_mean_force(const NodalState& s0, const NodalState& s1, NodalVector& f) const override {
    for (const SpringLink& link : links_) {
      const Stretched before = stretched(link, s0.u), after = stretched(link, s1.u);
      const double mean = relative(link, before.elongation + after.elongation, before.length + after.length);
      link.add_force(-k_ / 2 * mean * (before.span + after.span), f);
    }
  }

  void add_tangent(const NodalState& s, TangentKind kind, double* stiffness, double*) const override {
    for (const SpringLink& link : links_) {
      const auto [d, length, elongation] = stretched(link, s.u);
      double across = relative(link, elongation, length);  // negative in compression
      if (kind == TangentKind::gauss_newton) across = std::max(across, 0.0);
      Mat3 block = across * Mat3::Identity();
      if (link.free_length > 0) block += (1 - across) / (length * length) * d * d.transpose();
      link.add_block(k_ * block, pattern_, stiffness);
    }
  }

  EnergyKind energy_kind() const override { return EnergyKind::elastic; }

  double energy(const NodalState& s) const override {
    double sum = 0;
    for (const SpringLink& link : links_) {
      const double elongation = stretched(link, s.u).elongation;
      sum += 0.5 * k_ * elongation * elongation;
    }
    return sum;
  }

  void add_stiffness_bound(Vector& row_sums) const override {
    for (const SpringLink& link : links_) link.add_row_sum(k_, row_sums);
  }

 private:
  double k_;
  std::vector<SpringLink> links_;
  const BlockPattern& pattern_;
};

class SpringChoice : public TermChoice, public Ends {
 public:
  static const Spec<SpringChoice>& spec() {
    using S = SpringChoice;
    static const auto s =
        ends_spec<S>()
            .key("stiffness", &S::stiffness_,
                 "Sum of the stiffnesses of all springs; each selected node has an equal share.",
                 {.required = true, .unit = "N/m", .range = kPositive})
            .key("rest_length", &S::rest_length_, "Length without force; default: the length at rest.",
                 {.unit = "m", .range = kNonNegative})
            .check([](const S& spring, const Config& config) {
              spring.Ends::check(config);
              if (spring.in_place() && spring.rest_length_.value_or(0) > 0)
                config.at("rest_length")
                    .fail("needs an 'anchor': a node tied to its own rest position has no direction");
            });
    return s;
  }

  std::unique_ptr<Term> make(const Discretization& body) const override {
    std::vector<SpringLink> springs;
    for (const Link& link : links(body.mesh)) {
      const Vec3 at_rest = link.span(body.rest);
      const double free_length = rest_length_.value_or(at_rest.norm());
      if (at_rest.norm() == 0 && free_length > 0)
        origin.fail("a node lies on the anchor, so its spring has no direction");
      springs.push_back({link, at_rest, free_length});
    }
    const double each = stiffness_ / static_cast<double>(springs.size());
    return std::make_unique<Springs>(each, std::move(springs), body.pattern);
  }

  NodePairs couplings(const Mesh& mesh) const override { return Ends::couplings(mesh); }

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
