#include "lib/fem/terms/dashpot.h"

#include <fmt/format.h>

#include "lib/core/errors.h"
#include "lib/fem/term_choice.h"
#include "lib/fem/terms/ends.h"

namespace orthodyn {

std::string Dashpots::description() const { return fmt::format("{}: {} of {:.6g} N s/m", name(), links_.size(), c_); }

Mat3 Dashpots::matrix(const Link& link, const NodalVector& x) const {
  if (law_ == DashpotLaw::all_directions) return c_ * Mat3::Identity();
  const Vec3 d = link.span(x);
  if (!(d.norm() > 0)) throw RecoverableError("a dashpot has shrunk to a point and has no direction");
  const Vec3 n = d.normalized();
  return c_ * n * n.transpose();
}

void Dashpots::add_force(const NodalState& s, NodalVector& f) const {
  for (const Link& link : links_) link.add_force(-matrix(link, s.x) * link.change(s.v), f);
}

void Dashpots::add_tangent(const NodalState& s, TangentKind, double*, double* damping) const {
  if (!damping) return;
  for (const Link& link : links_) link.add_block(matrix(link, s.x), pattern_, damping);
}

double Dashpots::dissipation(const NodalState& s) const {
  double sum = 0;
  for (const Link& link : links_) {
    const Vec3 rate = link.change(s.v);
    sum += rate.dot(matrix(link, s.x) * rate);
  }
  return sum;
}

namespace {

class DashpotChoice : public TermChoice, public Ends {
 public:
  static const Spec<DashpotChoice>& spec() {
    using D = DashpotChoice;
    static const auto s =
        ends_spec<D>()
            .key("coefficient", &D::coefficient_, "Total of all dashpots, shared evenly by the selected nodes.",
                 {.required = true, .unit = "N s/m", .range = kPositive})
            .check([](const D& dashpot, const Config& config) { dashpot.Ends::check(config); });
    return s;
  }

  std::unique_ptr<Term> make(const Discretization& body) const override {
    std::vector<Link> all = links(body.mesh);
    if (!in_place())
      for (const Link& link : all)
        if (link.span(body.rest).norm() == 0)
          origin.fail("a node lies on the anchor, so that its dashpot has no direction");
    const double each = coefficient_ / static_cast<double>(all.size());
    return std::make_unique<Dashpots>(each, in_place() ? DashpotLaw::all_directions : DashpotLaw::along, std::move(all),
                                      body.pattern);
  }

  NodePairs couplings(const TetMesh& mesh) const override { return Ends::couplings(mesh); }

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
    "Dashpots between two nodes, or from nodes to an anchor, against the rate of their length; without anchor, against "
    "all motion of the nodes.");

}  // namespace
}  // namespace orthodyn
