// Reading a document: places, scalars, default values and the way back to YAML.
#include "lib/config/config.h"

#include <gtest/gtest.h>

#include "tests/config/messages.h"

namespace orthodyn {
namespace {

const char* kScene = R"(name: beam
mesh:
  size: [1, 2.5, three]
  file: parts/beam.msh
  # a comment
  deep: {count: 7}
fast: true
nothing:
)";

Config scene() { return Config::from_text(kScene, "in/beam.yaml"); }

TEST(Config, AValueKnowsItsLineAndColumn) {
  EXPECT_EQ(scene().at("mesh").at("file").where(), "in/beam.yaml:4:9: mesh.file");
}

TEST(Config, AnEntryOfAListKnowsItsPlaceAndIndex) {
  EXPECT_EQ(scene().at("mesh").at("size").at(2).where(), "in/beam.yaml:3:18: mesh.size.2");
}

TEST(Config, AnErrorBeginsWithThePlace) {
  const Config at = scene().at("mesh").at("size").at(2);
  EXPECT_EQ(refusal([&] { at.number(); }), "in/beam.yaml:3:18: mesh.size.2: expected a number, found 'three'");
}

TEST(Config, KeysComeInTheOrderOfTheFile) {
  EXPECT_EQ(scene().keys(), (std::vector<std::string>{"name", "mesh", "fast", "nothing"}));
}

TEST(Config, AskingForAKeyDoesNotCreateIt) {
  const Config config = scene();
  EXPECT_FALSE(config.has("absent"));
  EXPECT_EQ(config.keys().size(), 4u);
  EXPECT_FALSE(config.at("name").has("below_a_value"));
}

TEST(Config, ScalarsOfEachKindAreRead) {
  const Config config = scene();
  EXPECT_EQ(config.at("name").text(), "beam");
  EXPECT_EQ(config.at("mesh").at("size").at(1).number(), 2.5);
  EXPECT_EQ(config.at("mesh").at("deep").at("count").integer(), 7);
  EXPECT_TRUE(config.at("fast").boolean());
  EXPECT_TRUE(config.at("nothing").is_null());
}

TEST(Config, NumbersMayBeWrittenInTheUsualWays) {
  const Config config = Config::from_text("[1e-3, +2, -.5, 3., 1E3]");
  EXPECT_EQ(config.at(0).number(), 1e-3);
  EXPECT_EQ(config.at(1).number(), 2);
  EXPECT_EQ(config.at(2).number(), -0.5);
  EXPECT_EQ(config.at(3).number(), 3);
  EXPECT_EQ(config.at(4).integer(), 1000);
}

TEST(Config, AFileIsNamedRelativeToTheInputFile) {
  EXPECT_EQ(scene().at("mesh").at("file").file_path(), "in/parts/beam.msh");
}

TEST(Config, AnAbsoluteFileIsLeftAlone) {
  EXPECT_EQ(Config::from_text("/a/b.msh", "in/x.yaml").file_path(), "/a/b.msh");
}

TEST(Config, ShownIsShortForLongValues) {
  EXPECT_EQ(Config::from_text(std::string(100, 'x')).shown(), "'" + std::string(57, 'x') + "...'");
}

TEST(Config, DumpIsReadBackToTheSameDocument) {
  const Config again = Config::from_text(scene().dump());
  EXPECT_EQ(again.keys(), scene().keys());
  EXPECT_EQ(again.at("mesh").at("size").at(1).number(), 2.5);
  EXPECT_EQ(again.dump(), scene().dump());
}

TEST(Config, AFilledValueIsReadableAndInTheDump) {
  const Config config = scene();
  const Config filled = config.at("mesh").fill("split", "six");
  EXPECT_EQ(filled.text(), "six");
  EXPECT_EQ(filled.path(), "mesh.split");
  EXPECT_EQ(Config::from_text(config.dump()).at("mesh").at("split").text(), "six");
}

TEST(Config, AFilledNumberSurvivesTheDumpToTheLastBit) {
  const Config config = scene();
  config.fill("x", "0.1000000000000000055511151231257827");
  EXPECT_EQ(Config::from_text(config.dump()).at("x").number(), 0.1);
}

TEST(Config, AFilledValueHasNoLineOfItsOwn) {
  const Config filled = scene().at("mesh").fill("split", "{kind: six}");
  EXPECT_EQ(filled.at("kind").where(), "in/beam.yaml: mesh.split.kind");
}

TEST(Config, AnAliasReadsAsWhatItNames) {
  const Config config = Config::from_text("a: &x {v: 3}\nb: *x\n");
  EXPECT_EQ(config.at("b").at("v").integer(), 3);
}

TEST(Config, JoinSeparatesNames) {
  EXPECT_EQ(join({"a", "b", "c"}), "a, b, c");
  EXPECT_EQ(join({"a", "b"}, "|"), "a|b");
  EXPECT_EQ(join({}), "");
}

TEST(NearestName, IsTheEntryWithTheFewestEdits) {
  const std::vector<std::string> names{"density", "young", "shear_factor"};
  EXPECT_EQ(nearest_name("densty", names), "density");
  EXPECT_EQ(nearest_name("yuong", names), "young");
  EXPECT_EQ(nearest_name("shearfactor", names), "shear_factor");
}

TEST(NearestName, IsEmptyIfNothingIsNear) {
  EXPECT_EQ(nearest_name("gravity", {"density", "young"}), "");
  EXPECT_EQ(nearest_name("x", {}), "");
}

TEST(NearestName, PrefersTheExactEntry) { EXPECT_EQ(nearest_name("nu12", {"nu21", "nu13", "nu12"}), "nu12"); }

}  // namespace
}  // namespace orthodyn
