// Every integrator on a small corotational beam: large rotations, damping, oblique fibres.
#include "lib/simulation/run/setup.h"
#include "tests/contract/integrators.h"
#include "tests/fem/built_scene.h"

namespace orthodyn::beam_test {
namespace {

constexpr double kEnd = 0.5;

const BuiltTestScene& beam() {
  static const BuiltTestScene scene(R"(
mesh: {type: box, size: [1, 0.2, 0.2], cells: [3, 1, 1], order: 1}
materials: {wood: {type: orthotropic_stable, density: 1000, young: [2e6, 2e5, 1e5], nu: 0.3}}
regions: {all: {material: wood, axes: {first: [0.8, 0.6, 0], second: [-0.6, 0.8, 0]}}}
gravity: [0, 0, -4]
damping: {stiffness: 0.005}
clamps: [{surface: x0}]
time: {end: 0.5}
)");
  return scene;
}

State end_of(const std::string& options) {
  const auto& b = beam();
  const auto choice = Registry<IntegratorChoice>::read(Config::from_text("{" + options + "}"));
  const auto integrator = choice->make(b.model(), task_of(b.scene, b.built));
  integrator->start(b.built.initial);
  while (integrator->step(kEnd).t < kEnd) {
  }
  State state;
  integrator->interpolate(kEnd, state);
  return state;
}

const State& reference() {
  static const State state = end_of("type: arkode_dirk, rtol: 1e-9");
  return state;
}

// Error relative to the largest displacement.
double error_of(const std::string& options) {
  const Vector& q = reference().q;
  return (end_of(options).q - q).lpNorm<Eigen::Infinity>() / q.lpNorm<Eigen::Infinity>();
}

class SmallBeam : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Registry, SmallBeam, testing::ValuesIn(Registry<IntegratorChoice>::names()),
                         [](const auto& tested) { return tested.param; });

TEST_P(SmallBeam, EndsWhereTheReferenceDoes) {
  if (tested(GetParam()).linear_only) GTEST_SKIP() << "the beam is not linear";
  const Variant& usual = tested(GetParam()).variants.front();
  const std::string type = "type: " + GetParam() + tested(GetParam()).needs + usual.options;
  const double allowed = usual.order == 1 ? 2e-2 : 2e-3;
  if (controls_its_error(GetParam())) {
    EXPECT_LE(error_of(type + ", rtol: 1e-5"), allowed);
  }
  if (has_key(GetParam(), "step")) {
    EXPECT_LE(error_of(type + (usual.order == 1 || !tested(GetParam()).stiff ? ", step: 1e-4" : ", step: 5e-4")),
              allowed);
  }
}

// The reference is computed by one of the integrators; two of other families agree with it.
TEST(SmallBeamReference, IsThatOfTwoOtherMethods) {
  EXPECT_LE(error_of("type: cvode_bdf, rtol: 1e-8, max_order: 5"), 1e-5);
  EXPECT_LE(error_of("type: ida_bdf, rtol: 1e-8, max_order: 5"), 1e-5);
}

}  // namespace
}  // namespace orthodyn::beam_test
