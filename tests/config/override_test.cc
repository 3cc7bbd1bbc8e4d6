// --set PATH=VALUE: changes the document from the command line.
#include <gtest/gtest.h>

#include "lib/config/config.h"
#include "tests/config/messages.h"

namespace orthodyn::override_test {
namespace {

Config scene() {
  return Config::from_text("mesh:\n  size: [1, 2, 3]\nloads:\n  - {name: a}\n  - {name: b}\nempty:\n", "a.yaml");
}

std::string refusal_of(const std::string& assignment) {
  return refusal([&] { scene().override_with(assignment); });
}

TEST(Override, AValueReplacesTheOneInTheFile) {
  Config config = scene();
  config.override_with("mesh.size=[4, 5]");
  EXPECT_EQ(config.at("mesh").at("size").size(), 2u);
  EXPECT_EQ(config.at("mesh").at("size").at(1).number(), 5);
}

TEST(Override, AnIndexReachesAnEntryOfAList) {
  Config config = scene();
  config.override_with("mesh.size.1=7");
  EXPECT_EQ(config.at("mesh").at("size").at(1).number(), 7);
  EXPECT_EQ(config.at("mesh").at("size").at(2).number(), 3);
}

TEST(Override, AnIndexReachesThroughAListOfSections) {
  Config config = scene();
  config.override_with("loads.1.name=c");
  EXPECT_EQ(config.at("loads").at(0).at("name").text(), "a");
  EXPECT_EQ(config.at("loads").at(1).at("name").text(), "c");
}

TEST(Override, MissingSectionsAreMade) {
  Config config = scene();
  config.override_with("integrator.newton.rtol=1e-5");
  EXPECT_EQ(config.at("integrator").at("newton").at("rtol").number(), 1e-5);
}

TEST(Override, AnEmptySectionCanBeFilled) {
  Config config = scene();
  config.override_with("empty.x=1");
  EXPECT_EQ(config.at("empty").at("x").integer(), 1);
}

TEST(Override, TheLastOfTwoWins) {
  Config config = scene();
  config.override_with("x=1");
  config.override_with("x=2");
  EXPECT_EQ(config.at("x").integer(), 2);
}

TEST(Override, TheValueMayHoldAnEqualsSign) {
  Config config = scene();
  config.override_with("title=a=b");
  EXPECT_EQ(config.at("title").text(), "a=b");
}

TEST(Override, IsNamedAsThePlaceOfTheValueAndOfAllBelow) {
  Config config = scene();
  config.override_with("mesh={type: box, cells: [1, x], order: 1}");
  EXPECT_EQ(config.at("mesh").at("cells").at(1).where(), "a.yaml: --set mesh.cells.1");
  EXPECT_EQ(refusal([&] { config.at("mesh").at("type").number(); }),
            "a.yaml: --set mesh.type: expected a number, found 'box'");
}

TEST(Override, LeavesThePlacesOfItsNeighboursAlone) {
  Config config = scene();
  config.override_with("mesh.size.1=7");
  EXPECT_EQ(config.at("mesh").at("size").at(2).where(), "a.yaml:2:16: mesh.size.2");
  config.override_with("load=1");
  EXPECT_EQ(config.at("loads").at(0).at("name").where(), "a.yaml:4:12: loads.0.name");
}

TEST(Override, IsPartOfTheDump) {
  Config config = scene();
  config.override_with("mesh.size.0=9");
  EXPECT_EQ(Config::from_text(config.dump()).at("mesh").at("size").at(0).integer(), 9);
}

TEST(Override, OfAnAliasedValueIsRefusedRatherThanChangedInTwoPlaces) {
  const std::string message = refusal([] { Config::from_text("a: &x {v: 1}\nb: *x\n").override_with("b.v=2"); });
  EXPECT_TRUE(holds(message, "--set b.v=2: 'b' is used in several places through an alias"));
}

// If an override creates an entry that lacks a required key, its name may be a misspelling of an existing one.
TEST(Override, ANewEntryThatIsRefusedNamesTheOneWithANearName) {
  Config config = Config::from_text("materials: {spruce: {type: a}, oak: {type: a}}", "a.yaml");
  config.override_with("materials.spuce.young=1e9");
  config.override_with("materials.teflon.young=1e9");
  const auto said = [&](const char* name) { return refusal([&] { config.at("materials").at(name).fail("no type"); }); };
  EXPECT_TRUE(holds(said("spuce"), "no type; 'spuce' is a new key; did you mean 'spruce'?"));
  EXPECT_TRUE(holds(refusal([&] { config.resolving().at("materials").at("spuce").fail("no type"); }), "'spruce'"));
  for (const char* name : {"teflon", "spruce"}) EXPECT_FALSE(holds(said(name), "did you mean")) << name;
}

TEST(Override, WithoutAnEqualsSignIsRefused) {
  EXPECT_EQ(refusal_of("mesh.size"), "--set mesh.size: expected PATH=VALUE, such as integrator.rtol=1e-5");
  EXPECT_TRUE(holds(refusal_of("=3"), "expected PATH=VALUE"));
}

TEST(Override, WithoutAValueIsRefused) { EXPECT_TRUE(holds(refusal_of("mesh.size="), "expected PATH=VALUE")); }

TEST(Override, OfAnIndexBeyondTheListIsRefused) {
  EXPECT_EQ(refusal_of("mesh.size.3=1"), "--set mesh.size.3=1: '3' is not an index of the list; expected 0 to 2");
  EXPECT_TRUE(holds(refusal_of("mesh.size.-1=1"), "'-1' is not an index"));
  EXPECT_TRUE(holds(refusal_of("loads.name=1"), "'name' is not an index of the list; expected 0 to 1"));
}

TEST(Override, BelowAValueIsRefused) {
  EXPECT_TRUE(holds(refusal_of("loads.0.name.x=1"), "'loads.0.name' is a value"));
}

TEST(Override, WithAnEmptyStepIsRefused) {
  EXPECT_TRUE(holds(refusal_of("mesh..x=1"), "expected PATH=VALUE"));
  EXPECT_TRUE(holds(refusal_of("mesh.=1"), "expected PATH=VALUE"));
}

TEST(Override, ThatIsNotYamlIsRefusedWithItsText) {
  const std::string message = refusal_of("mesh.size=[1");
  EXPECT_TRUE(starts(message, "--set mesh.size=[1"));
  EXPECT_TRUE(holds(message, "not YAML"));
}

}  // namespace
}  // namespace orthodyn::override_test
