// The term `point_load`.

#include "lib/core/spelling.h"
#include "lib/fem/term_choice.h"
#include "lib/fem/terms/dead_load.h"
#include "lib/mesh/selection.h"

namespace orthodyn {
namespace {

class PointLoadChoice : public TermChoice, public Selection {
 public:
  static const Spec<PointLoadChoice>& spec() {
    using P = PointLoadChoice;
    static const auto s =
        selection_spec<P>()
            .key("force", &P::force_, "In total, shared evenly by the selected nodes.", {.required = true, .unit = "N"})
            .key("factor", &P::factor_, "Factor in time.", {.fallback = "{type: constant}"})
            .check([](const P& load, const Config& config) { load.check(config); });
    return s;
  }

  std::unique_ptr<Term> make(const Discretization& body) const override {
    const auto selected = selected_nodes(*this, body.mesh);
    NodalForces forces;
    for (const int node : selected) forces.emplace_back(node, force_ / static_cast<double>(selected.size()));
    return std::make_unique<DeadLoad>("point load", std::move(forces), factor_,
                                      counted(static_cast<long>(selected.size()), "node"));
  }

  const TimeFunction* factor_in_time() const override { return factor_.get(); }
  void declare(Traits& traits) const override { declare_load(*factor_, traits); }

 private:
  Vec3 force_ = Vec3::Zero();
  std::shared_ptr<const TimeFunction> factor_;
};

const bool point_load_registered =
    Registry<TermChoice>::add<PointLoadChoice>("point_load", "A dead force on a node, or shared by several nodes.");

}  // namespace
}  // namespace orthodyn
