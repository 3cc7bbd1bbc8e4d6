#include "lib/fem/terms/ground.h"

#include "lib/fem/surface.h"
#include "lib/mesh/selection.h"
#include "lib/scene/term_choice.h"

namespace orthodyn {
namespace {

constexpr double kUsualOnset = 1e-3;  // of the mesh's diagonal

class GroundChoice : public TermChoice {
 public:
  static const Spec<GroundChoice>& spec() {
    using G = GroundChoice;
    static const auto s =
        Spec<G>()
            .key("point", &G::point_, "A point of the plane.", {.unit = "m"})
            .key("normal", &G::normal_, "Away from the ground, of any length.")
            .key("stiffness", &G::stiffness_, "Pressure per depth.",
                 {.required = true, .unit = "Pa/m", .range = kPositive})
            .key("onset", &G::onset_, "Depth over which contact sets in; default 1e-3 of the mesh's diagonal.",
                 {.unit = "m", .range = kPositive})
            .key("surface", &G::surface_, "What can touch it: a named surface; default the whole outer surface.")
            .check([](const G& ground, const Config& config) {
              if (ground.normal_.norm() == 0) config.at("normal").fail("is zero; give a direction");
            });
    return s;
  }

  std::unique_ptr<Term> make(const FemModel::Parts& parts) const override {
    const auto triangles = surface_or_all(parts.mesh, surface_, origin);
    std::vector<std::pair<int, double>> areas;
    for (const auto& [node, share] : surface_forces(parts.mesh, triangles, Vec3::UnitX()))
      areas.emplace_back(node, share[0]);
    const double onset = onset_.value_or(kUsualOnset * bounding_box(parts.mesh).diagonal());
    return std::make_unique<Ground>(GroundPlane{point_, normal_.normalized(), stiffness_, onset}, std::move(areas),
                                    *parts.pattern);
  }

  void declare(Traits& traits) const override { traits.linear = false; }

  Origin origin;

 private:
  Vec3 point_ = Vec3::Zero(), normal_{0, 0, 1};
  double stiffness_ = 0;
  std::optional<double> onset_;
  std::optional<std::string> surface_;
};

const bool registered = Registry<TermChoice>::add<GroundChoice>(
    "ground", "A rigid plane that pushes back what is below it, by a smooth penalty; no friction, no damping.");

}  // namespace
}  // namespace orthodyn
