// The term `pressure`: a follower load, or a dead load with the areas and normals of the rest shape.
#include "lib/config/formula.h"
#include "lib/fem/surface.h"
#include "lib/fem/term_choice.h"
#include "lib/fem/terms/dead_load.h"
#include "lib/fem/terms/pressure.h"
#include "lib/mesh/selection.h"

namespace orthodyn {
namespace {

class PressureChoice : public TermChoice {
 public:
  static const Spec<PressureChoice>& spec() {
    using P = PressureChoice;
    static const auto s = Spec<P>()
                              .key("surface", &P::surface_, "A named surface; default the whole outer surface.")
                              .key("pressure", &P::pressure_,
                                   "Positive where it pushes on the body: a number, or a formula of the rest position.",
                                   {.required = true, .unit = "Pa"})
                              .key("follows", &P::follows_,
                                   "true: a follower load, which turns and grows with the surface. false: a dead load "
                                   "with the areas and normals at rest. Default true; false with kinematics: linear.")
                              .key("factor", &P::factor_, "Factor in time.", {.fallback = "{type: constant}"});
    return s;
  }

  // By default, pressure keeps a linear model linear.
  Defaults defaults(const ElasticityOptions& elasticity) const override {
    return {{"follows", elasticity.kinematics == Kinematics::linear ? "false" : "true"}};
  }

  std::unique_ptr<Term> make(const Discretization& body) const override {
    const std::string where = surface_.value_or("the whole outer surface");
    PressedFaces faces(body.mesh, surface_or_all(body.mesh, surface_, origin), pressure_);
    if (follows()) return std::make_unique<Pressure>(where, std::move(faces), factor_, body.pattern);
    return std::make_unique<DeadLoad>("pressure on " + where, pressure_forces(faces, body.rest), factor_, "dead");
  }

  bool has_symmetric_tangent(const Mesh& mesh, const std::vector<bool>& held) const override {
    if (!follows()) return true;
    NodalVector rest(3, static_cast<Eigen::Index>(mesh.nodes.size()));
    for (Eigen::Index i = 0; i < rest.cols(); ++i) rest.col(i) = mesh.nodes[static_cast<std::size_t>(i)];
    return has_symmetric_stiffness({mesh, surface_or_all(mesh, surface_, origin), pressure_}, rest, held);
  }

  const TimeFunction* factor_in_time() const override { return factor_.get(); }

  // The stiffness of follower pressure depends on the shape. Its work on an open surface depends on the path.
  void declare(Traits& traits) const override {
    declare_load(*factor_, traits);
    if (follows()) traits.linear = traits.conservative = false;
  }

  SourceLocation origin;

 private:
  bool follows() const { return follows_.value_or(true); }

  std::optional<std::string> surface_;
  PointQuantity pressure_;
  std::optional<bool> follows_;
  std::shared_ptr<const TimeFunction> factor_;
};

const bool pressure_registered =
    Registry<TermChoice>::add<PressureChoice>("pressure",
                                              "Pressure on a surface: a follower load (dynamic runs take the symmetric "
                                              "part of an unsymmetric stiffness), or dead.");

}  // namespace
}  // namespace orthodyn
