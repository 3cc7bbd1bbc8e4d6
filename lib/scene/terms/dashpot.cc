#include "lib/fem/terms/dashpot.h"

#include "lib/scene/term_choice.h"
#include "lib/scene/terms/ends.h"

namespace orthodyn {
namespace {

class DashpotChoice : public TermChoice, public Ends {
 public:
  static const Spec<DashpotChoice>& spec() {
    using D = DashpotChoice;
    static const auto s =
        ends_spec<D>()
            .key("coefficient", &D::coefficient_, "Of all dashpots together, shared evenly by the selected nodes.",
                 {.required = true, .unit = "N s/m", .range = kPositive})
            .check([](const D& dashpot, const Config& config) { dashpot.Ends::check(config); });
    return s;
  }

  std::unique_ptr<Term> make(const FemModel::Parts& parts) const override {
    std::vector<Link> all = links(parts.mesh);
    if (!in_place())
      for (const Link& link : all)
        if (link.span(*parts.rest).norm() == 0)
          origin.fail("a node lies on the anchor, so that its dashpot has no direction");
    const double each = coefficient_ / static_cast<double>(all.size());
    return std::make_unique<Dashpots>(each, in_place() ? DashpotLaw::all_directions : DashpotLaw::along, std::move(all),
                                      *parts.pattern);
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

const bool registered = Registry<TermChoice>::add<DashpotChoice>(
    "dashpot",
    "Dashpots between two nodes, or from nodes to an anchor, against the rate of their length; without anchor, against "
    "all motion of the nodes.");

}  // namespace
}  // namespace orthodyn
