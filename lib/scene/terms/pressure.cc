#include "lib/fem/terms/pressure.h"

#include "lib/mesh/selection.h"
#include "lib/scene/term_choice.h"

namespace orthodyn {
namespace {

class PressureChoice : public TermChoice {
 public:
  static const Spec<PressureChoice>& spec() {
    using P = PressureChoice;
    static const auto s =
        Spec<P>()
            .key("surface", &P::surface_, "A named surface; default the whole outer surface.")
            .key("pressure", &P::pressure_, "Positive where it pushes on the body.", {.required = true, .unit = "Pa"})
            .key("factor", &P::factor_, "Factor in time.", {.fallback = "{type: constant}"});
    return s;
  }

  std::unique_ptr<Term> make(const FemModel::Parts& parts) const override {
    return std::make_unique<Pressure>(surface_.value_or("the whole outer surface"),
                                      surface_or_all(parts.mesh, surface_, origin), pressure_, factor_, *parts.pattern);
  }

  // Its stiffness changes with the shape; an open surface's work depends on the path.
  void declare(Traits& traits) const override {
    traits.linear = traits.conservative = false;
    traits.loaded = true;
    if (!factor_->constant()) traits.time_dependent = true;
  }

  Origin origin;

 private:
  std::optional<std::string> surface_;
  double pressure_ = 0;
  std::shared_ptr<const TimeFunction> factor_;
};

const bool registered = Registry<TermChoice>::add<PressureChoice>(
    "pressure", "Pressure on a surface that follows its motion; the symmetric part of its stiffness enters K.");

}  // namespace
}  // namespace orthodyn
