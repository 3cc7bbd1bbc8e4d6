#include "lib/fem/terms/spring.h"

#include "lib/scene/term_choice.h"
#include "lib/scene/terms/ends.h"

namespace orthodyn {
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

  std::unique_ptr<Term> make(const FemModel::Parts& parts) const override {
    std::vector<SpringLink> springs;
    for (const Link& link : links(parts.mesh)) {
      const double length = link.span(*parts.rest).norm();
      const double rest_length = rest_length_.value_or(length);
      if (length == 0 && rest_length > 0) origin.fail("a node lies on the anchor, so that its spring has no direction");
      springs.push_back({link, rest_length});
    }
    const double each = stiffness_ / static_cast<double>(springs.size());
    return std::make_unique<Springs>(each, std::move(springs), *parts.pattern);
  }

  NodePairs couplings(const TetMesh& mesh) const override { return Ends::couplings(mesh); }

  void declare(Traits& traits) const override {
    if (!in_place() && rest_length_ != 0.0) traits.linear = false;
  }

 private:
  double stiffness_ = 0;
  std::optional<double> rest_length_;
};

const bool registered = Registry<TermChoice>::add<SpringChoice>(
    "spring",
    "Springs between two nodes, or from nodes to the ground: k (l - l0) along the spring, for any displacement.");

}  // namespace
}  // namespace orthodyn
