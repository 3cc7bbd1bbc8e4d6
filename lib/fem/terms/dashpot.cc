// Dashpots resist the rate of change d' of the span d of a link, with coefficient c (N s/m). Along the link with its
// current direction n they have
//   force on node a -c n (n . d'),  dissipated power c (n . d')^2,  damping matrix c n n^T.
// A dashpot between a node and its own rest position resists all motion: force -c d', power c |d'|^2, matrix c I. K
// neglects the dependence of n on position; the Newton matrix is then approximate, the force exact. A link of length
// zero has no direction and throws RecoverableError.
#include <fmt/format.h>

#include "lib/core/errors.h"
#include "lib/fem/term_choice.h"
#include "lib/fem/terms/link.h"

namespace orthodyn {
namespace {

enum class DashpotLaw { along, all_directions };

class Dashpots : public Term {
 public:
  // `coefficient` of each dashpot (N s/m). The pattern must outlive the term and couple the ends.
  Dashpots(double coefficient, DashpotLaw law, std::vector<Link> links, const BlockPattern& pattern)
      : c_(coefficient), law_(law), links_(std::move(links)), pattern_(pattern) {}

  std::string name() const override { return "dashpots"; }
  std::string description() const override { return fmt::format("{}: {} of {:.6g} N s/m", name(), links_.size(), c_); }
  std::unique_ptr<Term> part(const Subdomain& subdomain) const override {
    return std::make_unique<Dashpots>(c_, law_, owned_links(links_, subdomain), pattern_);
  }
  std::size_t bytes() const override { return links_.capacity() * sizeof(Link); }

  void add_force(const NodalState& s, NodalVector& f) const override {
    for (const Link& link : links_) link.add_force(-matrix(link, s.x) * link.change(s.v), f);
  }

  void add_tangent(const NodalState& s, TangentKind, double*, double* damping) const override {
    if (!damping) return;
    for (const Link& link : links_) link.add_block(matrix(link, s.x), pattern_, damping);
  }

  double dissipation(const NodalState& s) const override {
    double sum = 0;
    for (const Link& link : links_) {
      const Vec3 rate = link.change(s.v);
      sum += rate.dot(matrix(link, s.x) * rate);
    }
    return sum;
  }

 private:
  // Damping matrix, N s/m.
  Mat3 matrix(const Link& link, const NodalVector& x) const {
    if (law_ == DashpotLaw::all_directions) return c_ * Mat3::Identity();
    const Vec3 d = link.span(x);
    if (!(d.norm() > 0)) throw RecoverableError("a dashpot has zero length and no direction");
    const Vec3 n = d.normalized();
    return c_ * n * n.transpose();
  }

  double c_;
  DashpotLaw law_;
  std::vector<Link> links_;
  const BlockPattern& pattern_;
};

class DashpotChoice : public TermChoice, public Ends {
 public:
  static const Spec<DashpotChoice>& spec() {
    using D = DashpotChoice;
    static const auto s = ends_spec<D>()
                              .key("coefficient", &D::coefficient_,
                                   "Sum of the coefficients of all dashpots; each selected node has an equal share.",
                                   {.required = true, .unit = "N s/m", .range = kPositive})
                              .check([](const D& dashpot, const Config& config) { dashpot.Ends::check(config); });
    return s;
  }

  std::unique_ptr<Term> make(const Discretization& body) const override {
    std::vector<Link> all = links(body.mesh);
    if (!in_place())
      for (const Link& link : all)
        if (link.span(body.rest).norm() == 0) origin.fail("a node lies on the anchor, so its dashpot has no direction");
    const double each = coefficient_ / static_cast<double>(all.size());
    return std::make_unique<Dashpots>(each, in_place() ? DashpotLaw::all_directions : DashpotLaw::along, std::move(all),
                                      body.pattern);
  }

  NodePairs couplings(const Mesh& mesh) const override { return Ends::couplings(mesh); }

  void declare(Traits& traits) const override {
    traits.damping_matrix = traits.dissipative = true;
    traits.conservative = false;
    if (!in_place()) traits.linear = false;
  }

 private:
  double coefficient_ = 0;
};

const bool dashpot_registered = Registry<TermChoice>::add<DashpotChoice>(
    "dashpot",
    "Dashpots between two nodes, or from nodes to an anchor, that resist changes of their length; without an anchor "
    "they resist all motion of the nodes.");

}  // namespace
}  // namespace orthodyn
