// Input of motions and terms: errors and their messages.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/errors.h"
#include "lib/simulation/run/setup.h"
#include "tests/scene/scenes.h"

namespace orthodyn::motions_test {
namespace {

struct Refused {
  std::string name, added;
  std::vector<std::string> said;
};
void PrintTo(const Refused& r, std::ostream* os) { *os << r.name; }

const std::string kStep = "factor: {type: smooth_step, end: 1}";

class RefusedInput : public testing::TestWithParam<Refused> {};
INSTANTIATE_TEST_SUITE_P(
    Scenes, RefusedInput,
    testing::Values(
        Refused{
            "held_and_moved",
            "motions: [{surface: y0, translation: [1, 0, 0], " + kStep + "}]",
            {"motions.0", "moves component x of the node at [0, 0, 0] m", "already belongs to clamp_1", "components"}},
        Refused{"moved_twice",
                "motions: [{surface: x1, name: a, translation: [1, 0, 0], " + kStep +
                    "}, {nearest: [2, 1, 1], components: [y], displacement: [0, t, 0]}]",
                {"motions.1", "moves component y of the node at [2, 1, 1] m", "belongs to a"}},
        Refused{"no_factor",
                "motions: [{surface: x1, translation: [1, 0, 0]}]",
                {"motions.0", "'factor' is missing", "smooth_step"}},
        Refused{"no_motion",
                "motions: [{surface: x1}]",
                {"motions.0", "either translation and rotation", "formulas as displacement"}},
        Refused{"two_motions",
                "motions: [{surface: x1, translation: [1, 0, 0], displacement: [0, 0, 0], " + kStep + "}]",
                {"either"}},
        Refused{"kinks_of_a_factor",
                "motions: [{surface: x1, translation: [1, 0, 0], kinks: [1], " + kStep + "}]",
                {"kinks", "displacement only"}},
        Refused{"translation_of_free_coordinates",
                "motions: [{surface: x1, components: [x], translation: [0, 0, 0.01], " + kStep + "}]",
                {"motions.0.translation", "moves nothing", "'components'"}},
        Refused{"no_axis",
                "motions: [{surface: x1, rotation: {axis: [0, 0, 0], angle: 1 rad}, " + kStep + "}]",
                {"rotation.axis", "is zero"}},
        Refused{"a_length_for_an_angle",
                "motions: [{surface: x1, rotation: {axis: [0, 0, 1], angle: 3 m}, " + kStep + "}]",
                {"angle", "rad"}},
        Refused{"no_selection", "motions: [{translation: [1, 0, 0], " + kStep + "}]", {"exactly one of surface, box"}},
        Refused{"unknown_variable",
                "motions: [{surface: x1, displacement: [s, 0, 0]}]",
                {"displacement.0", "formula", "Known: t, x, y, z"}},
        Refused{"jump_of_velocity",
                "mass: consistent\nmotions: [{surface: x1, translation: [1, 0, 0], factor: {type: ramp, end: 1}}]",
                {"motions.0", "infinite force", "smooth_step", "mass: lumped"}},
        Refused{"name_twice",
                "motions: [{surface: x1, name: clamp_1, translation: [1, 0, 0], " + kStep + "}]",
                {"motions.0", "'clamp_1' is used twice"}},
        Refused{"no_name",
                "motions: [{surface: x1, name: a.b, translation: [1, 0, 0], " + kStep + "}]",
                {"'a.b' is not a valid name", "letters"}},
        Refused{"nothing_moves",
                "motions: [{box: {min: [0.5, 0, 0], max: [2, 1, 1]}, translation: [1, 0, 0], " + kStep + "}]",
                {"all nodes are clamped or moved"}},
        Refused{"spring_of_one_node",
                "terms: [{type: spring, between: [[2, 1, 1], [2.1, 1, 1]], stiffness: 1}]",
                {"terms.0", "same node"}},
        Refused{"spring_of_no_end", "terms: [{type: spring, stiffness: 1}]", {"exactly one of surface", "between"}},
        Refused{"spring_without_direction",
                "terms: [{type: spring, surface: x1, stiffness: 1, rest_length: 1}]",
                {"rest_length", "anchor"}},
        Refused{"spring_on_its_anchor",
                "terms: [{type: spring, nearest: [2, 1, 1], anchor: [2, 1, 1], stiffness: 1, rest_length: 1}]",
                {"terms.0", "lies on the anchor"}},
        Refused{"dashpot_on_its_anchor",
                "terms: [{type: dashpot, nearest: [2, 1, 1], anchor: [2, 1, 1], coefficient: 1}]",
                {"terms.0", "lies on the anchor"}},
        Refused{"negative_dashpot", "terms: [{type: dashpot, nearest: [2, 1, 1], coefficient: -1}]", {"coefficient"}},
        Refused{"anchor_between",
                "terms: [{type: spring, between: [[2, 1, 1], [0, 1, 1]], anchor: [2, 1, 1], stiffness: 1}]",
                {"anchor", "selected nodes"}},
        Refused{"pressure_nowhere",
                "terms: [{type: pressure, surface: x7, pressure: 1}]",
                {"terms.0", "no surface 'x7'", "x1"}},
        Refused{"ground_without_normal",
                "terms: [{type: ground_contact, normal: [0, 0, 0], stiffness: 1}]",
                {"normal", "is zero"}},
        Refused{"point_load_nowhere",
                "terms: [{type: point_load, box: {min: [5, 5, 5], max: [6, 6, 6]}, force: [1, 0, 0]}]",
                {"terms.0", "selects no node"}}),
    [](const auto& tested) { return tested.param.name; });

TEST_P(RefusedInput, IsRefusedWithTheReason) {
  const std::string message = refusal(kValidScene + GetParam().added + "\n");
  for (const auto& part : GetParam().said)
    EXPECT_NE(message.find(part), std::string::npos) << part << "\nin: " << message;
}

TEST(FormulaMotion, ThatHasNoValueSaysWhereAndWhen) {
  const auto built = build_text(kValidScene + "motions: [{surface: x1, displacement: [sqrt(0.05 - t), 0, 0]}]\n");
  const Vector zero = Vector::Zero(built.model->num_dofs());
  Vector f(zero.size());
  try {
    built.model->force(0.07, zero, zero, f);
    FAIL();
  } catch (const ConfigError& e) {
    const std::string message = e.what();
    for (const char* part : {"motions.0.displacement", "sqrt(0.05 - t)", "not a number", "t = 0.0", "x = 2"})
      EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST(FormulaMotion, ThatHasNoValueIsNotBlamedOnTheIntegrator) {
  const auto yaml = kValidScene + "motions: [{surface: x1, displacement: [sqrt(0.05 - t), 0, 0]}]\n";
  try {
    set_up(Config::from_text(yaml, "scene.yaml"));
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_EQ(std::string(e.what()).find("integrator"), std::string::npos) << e.what();
    EXPECT_EQ(std::string(e.what()).find("scene.yaml:"), 0u) << e.what();
  }
}

// t^2.5 has no value before t = 0.
TEST(FormulaMotion, IsNeverEvaluatedBeforeTheStart) {
  const Scene scene = read_scene(
      Config::from_text(kValidScene + "motions: [{surface: x1, displacement: [t^2.5, 0, 0], resolution: 1e-4}]\n"));
  const auto motion = scene.motions[0].motion(scene.time.start, scene.time.end, NodalVector(Vec3(2, 1, 1)));
  const double h = 1e-4;
  for (const double t : {0.0, h / 10, h, 100 * h}) {  // to within the rates' size at h from the singularity
    const Moved moved = motion->at(t, NodalVector(Vec3(2, 1, 1)));
    EXPECT_NEAR(moved.v(0, 0), 2.5 * std::pow(t, 1.5), 2.5 * std::pow(h, 1.5)) << t;
    EXPECT_NEAR(moved.a(0, 0), 3.75 * std::sqrt(t), 3.75 * std::sqrt(h)) << t;
  }
  EXPECT_TRUE(motion->has_continuous_velocity());
}

}  // namespace
}  // namespace orthodyn::motions_test
