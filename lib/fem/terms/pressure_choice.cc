// The term `pressure`: a follower load, or a dead load with the areas and normals of the rest shape.
#include <map>

#include "lib/config/formula.h"
#include "lib/fem/face_nodes.h"
#include "lib/fem/surface.h"
#include "lib/fem/term_choice.h"
#include "lib/fem/terms/dead_load.h"
#include "lib/fem/terms/pressure.h"
#include "lib/mesh/selection.h"

namespace orthodyn {
namespace {

template <Face F>
NodalForces forces_at_rest(const NodalVector& rest, const std::vector<PressedFace<F>>& faces) {
  std::map<int, Vec3> sums;
  for (const PressedFace<F>& face : faces) {
    const FaceNodes<F> forces = face.forces(rest);
    for (std::size_t a = 0; a < face.nodes.size(); ++a)
      sums.try_emplace(face.nodes[a], Vec3::Zero()).first->second += forces.col(static_cast<Eigen::Index>(a));
  }
  return {sums.begin(), sums.end()};
}

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
    return body.mesh.order() == 1 ? make_of<Tri3>(body) : make_of<Tri6>(body);
  }

  bool has_symmetric_tangent(const TetMesh& mesh, const std::vector<bool>& held) const override {
    if (!follows()) return true;
    const auto faces = surface_or_all(mesh, surface_, origin);
    return mesh.order() == 1 ? is_symmetric<Tri3>(mesh, faces, held) : is_symmetric<Tri6>(mesh, faces, held);
  }

  // The stiffness of follower pressure depends on the shape. Its work on an open surface depends on the path.
  void declare(Traits& traits) const override {
    declare_load(*factor_, traits);
    if (follows()) traits.linear = traits.conservative = false;
  }

  SourceLocation origin;

 private:
  bool follows() const { return follows_.value_or(true); }

  template <Face F>
  std::unique_ptr<Term> make_of(const Discretization& body) const {
    const std::string where = surface_.value_or("the whole outer surface");
    std::vector<PressedFace<F>> faces;
    for_each_face_of<F>(
        body.mesh, surface_or_all(body.mesh, surface_, origin),
        [&](std::span<const int> nodes, const FaceNodes<F>& X) { faces.emplace_back(nodes, X, pressure_); });
    if (follows()) return std::make_unique<Pressure<F>>(where, std::move(faces), factor_, body.pattern);
    return std::make_unique<DeadLoad>("pressure on " + where, forces_at_rest<F>(body.rest, faces), factor_, "dead");
  }

  template <Face F>
  bool is_symmetric(const TetMesh& mesh, const std::vector<Triangle>& triangles, const std::vector<bool>& held) const {
    std::vector<PressedFace<F>> faces;
    NodalVector rest(3, static_cast<Eigen::Index>(mesh.nodes.size()));
    for (Eigen::Index i = 0; i < rest.cols(); ++i) rest.col(i) = mesh.nodes[static_cast<std::size_t>(i)];
    for_each_face_of<F>(mesh, triangles, [&](std::span<const int> nodes, const FaceNodes<F>& X) {
      faces.emplace_back(nodes, X, pressure_);
    });
    return has_symmetric_stiffness<F>(faces, rest, held);
  }

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
