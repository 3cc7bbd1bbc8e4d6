// Differences between scenes, and those that a resumed run permits.
#include "lib/simulation/checkpoint/scene_changes.h"

#include <gtest/gtest.h>

namespace orthodyn::scene_changes_test {
namespace {

using Paths = std::vector<std::string>;

Paths changes(const std::string& before, const std::string& now) {
  return changed_keys(Config::from_text(before), Config::from_text(now));
}

TEST(SceneChanges, TheSameSceneHasNone) {
  const std::string scene = "mesh: {type: box, size: [1, 0.2]}\ntime: {end: 2}\n";
  EXPECT_EQ(changes(scene, scene), Paths{});
  EXPECT_EQ(changes(scene, "time: {end: 2}\nmesh: {size: [1, 0.2], type: box}\n"), Paths{});  // whatever the order
}

TEST(SceneChanges, ANumberIsTheSameHoweverItIsWritten) {
  EXPECT_EQ(changes("h: 0.025", "h: 25 mm"), Paths{});
  EXPECT_EQ(changes("h: 25 mm", "h: 2.5 cm"), Paths{});
  EXPECT_EQ(changes("rtol: 1e-3", "rtol: 0.001"), Paths{});
  EXPECT_EQ(changes("young: 11.9 GPa", "young: 11.9e9"), Paths{});
}

TEST(SceneChanges, AnotherNumberOrUnitIsAChange) {
  EXPECT_EQ(changes("h: 25 mm", "h: 26 mm"), Paths{"h"});
  EXPECT_EQ(changes("h: 1 m", "h: 1 s"), Paths{"h"});
  EXPECT_EQ(changes("type: box", "type: cylinder"), Paths{"type"});
}

TEST(SceneChanges, AreNamedByTheirPathsInTheOrderOfTheNewScene) {
  EXPECT_EQ(changes("a: {b: [1, 2, 3]}\nz: 1\ny: 1", "y: 2\nz: 1\na: {b: [1, 5, 3]}"), (Paths{"y", "a.b.1"}));
}

TEST(SceneChanges, AListOfAnotherLengthIsOneChange) {
  EXPECT_EQ(changes("clamps: [{surface: x0}]", "clamps: [{surface: x0}, {surface: x1}]"), Paths{"clamps"});
}

TEST(SceneChanges, AKeyThatComesOrGoesIsAChange) {
  EXPECT_EQ(changes("a: 1", "a: 1\nb: 2"), Paths{"b"});
  EXPECT_EQ(changes("a: 1\nb: 2", "a: 1"), Paths{"b"});
  EXPECT_EQ(changes("a: {b: 1}", "a: 1"), Paths{"a"});
}

// Round-off, such as by another number of threads, changes these explanations.
TEST(SceneChanges, WordsOfTheProgramAreNone) {
  EXPECT_EQ(changes("integrator: {type: modal, modes: 4, kept: 4 modes up to 1 Hz; the part left out is about 3e-16}",
                    "integrator: {type: modal, modes: 4, kept: 4 modes up to 1 Hz; the part left out is about 4e-16}"),
            Paths{});
  EXPECT_EQ(changes("integrator: {type: auto, because: it is light}", "integrator: {type: auto, because: it is dear}"),
            Paths{});
  EXPECT_EQ(changes("integrator: {type: modal, modes: 4, kept: a}", "integrator: {type: modal, modes: 5, kept: b}"),
            Paths{"integrator.modes"});
}

TEST(SceneChanges, AKeyWithoutAValueCountsAsAbsent) {
  EXPECT_EQ(changes("a: 1", "a: 1\nb:"), Paths{});
  EXPECT_EQ(changes("a: 1\nb:", "a: 1"), Paths{});
  EXPECT_EQ(changes("b:", "b: 1"), Paths{"b"});
}

TEST(SceneChanges, ARunThatGoesOnMayChangeItsEndAndLimitsOnly) {
  EXPECT_EQ(refused_changes({"time.end", "checkpoint", "checkpoint.every", "expect.0.value", "integrator.max_steps",
                             "integrator.h_min", "integrator.max_newton_iterations"}),
            Paths{});
  EXPECT_EQ(refused_changes({"time.start", "time.end", "integrator.rtol", "materials.soft.young"}),
            (Paths{"time.start", "integrator.rtol", "materials.soft.young"}));
  EXPECT_EQ(refused_changes({"time.ending", "expected", "time"}), (Paths{"time.ending", "expected", "time"}));
}

}  // namespace
}  // namespace orthodyn::scene_changes_test
