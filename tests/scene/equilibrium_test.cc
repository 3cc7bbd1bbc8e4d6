// The equilibrium with moving supports equals that with supports at rest in the same place.
#include <gtest/gtest.h>

#include "lib/simulation/run/setup.h"
#include "lib/simulation/statics/static_problem.h"
#include "tests/scene/scenes.h"

namespace orthodyn::equilibrium_test {
namespace {

// Stretched by u = 0.02 m s(t), with s(0.3) = 10 t^3 - 15 t^4 + 6 t^5; both rates of s are large there.
const std::string kStretched = R"(mesh: {type: box, size: [2, 1, 1], cells: [4, 2, 2], order: 1}
materials: {soft: {type: isotropic, density: 1000, young: 1e6, nu: 0}}
clamps: [{surface: x0}]
motions: [{surface: x1, translation: [0.02, 0, 0], factor: {type: smooth_step, end: 1}}]
)";
constexpr double kStretch = 0.02 * (10 * 0.027 - 15 * 0.0081 + 6 * 0.00243);

const char* const kKinds[] = {"", "mass: consistent\n", "damping: {stiffness: 0.1, mass: 3}\n",
                              "mass: consistent\ndamping: {stiffness: 0.1, mass: 3}\n"};

void expect_uniform_stretch(const FemModel& model, const Vector& q, const char* kind) {
  NodalVector u = NodalVector::Zero(3, model.parts().rest->cols());
  model.parts().dofs->add_to(q, u);
  for (Eigen::Index i = 0; i < u.cols(); ++i) {
    const double x = (*model.parts().rest)(0, i);
    if (x == 2) continue;  // moved
    EXPECT_NEAR(u(0, i), kStretch * x / 2, 1e-6 * kStretch) << kind << x;
  }
}

TEST(Equilibrium, OfAMovedBodyDependsNeitherOnDampingNorOnTheKindOfMass) {
  for (const char* kind : kKinds) {
    const Scene scene = read_scene(Config::from_text(kStretched + kind + "analysis: static\ntime: {end: 0.3}\n"));
    const BuiltScene built = build(scene);
    expect_uniform_stretch(*built.model, equilibrium(scene, built), kind);
  }
}

TEST(Equilibrium, AtTheStartOfAMotionIsThatOfSupportsAtRest) {
  for (const char* kind : kKinds) {
    const auto setup =
        set_up(Config::from_text(kStretched + kind + "start: equilibrium\ntime: {start: 0.3, end: 0.4}\n"));
    expect_uniform_stretch(*setup.built.model, setup.built.initial.q, kind);
  }
}

TEST(Equilibrium, HasReactionsThatCarryTheLoads) {
  for (const char* kind : kKinds) {
    const Scene scene = read_scene(Config::from_text(
        kStretched + kind + "gravity: [0, 0, -10]\nanalysis: static\ntime: {end: 0.3}\noutput: {reactions: true}\n"));
    const BuiltScene built = build(scene);
    const Vector q = equilibrium(scene, built);
    const auto of = [&](const char* name) {
      const auto all = built.model->evaluate(name, {0.3, q, Vector::Zero(q.size())});
      return Vec3(all[0], all[1], all[2]);
    };
    const double weight = 2 * 1000 * 10;
    EXPECT_LT((of("reaction.clamp_1") + of("reaction.motion_1") - Vec3(0, 0, weight)).norm(), 1e-5 * weight) << kind;
  }
}

}  // namespace
}  // namespace orthodyn::equilibrium_test
