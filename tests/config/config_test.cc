// Reading a document: places (file:line), scalars, default values, and writing it back as YAML.
#include "lib/config/config.h"

#include <gtest/gtest.h>

#include "tests/config/messages.h"

namespace orthodyn::config_test {
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
  const Config config = scene().resolving();
  const Config filled = config.at("mesh").fill("split", "six");
  EXPECT_EQ(filled.text(), "six");
  EXPECT_EQ(filled.path(), "mesh.split");
  EXPECT_EQ(Config::from_text(config.dump()).at("mesh").at("split").text(), "six");
}

TEST(Config, AFilledNumberSurvivesTheDumpToTheLastBit) {
  const Config config = scene().resolving();
  config.fill("x", "0.1000000000000000055511151231257827");
  EXPECT_EQ(Config::from_text(config.dump()).at("x").number(), 0.1);
}

TEST(Config, AFilledValueHasNoLineOfItsOwn) {
  const Config filled = scene().resolving().at("mesh").fill("split", "{kind: six}");
  EXPECT_EQ(filled.at("kind").where(), "in/beam.yaml: mesh.split.kind");
}

TEST(Config, ACopyIsADocumentOfItsOwnThatSpeaksOfTheSamePlaces) {
  const Config config = scene();
  Config copy = config.copy();
  copy.set("mesh.size.0", 7.5);
  EXPECT_EQ(copy.at("mesh").at("size").at(0).number(), 7.5);
  EXPECT_EQ(config.dump(), scene().dump());
  EXPECT_EQ(copy.at("mesh").at("size").at(2).where(), scene().at("mesh").at("size").at(2).where());
  EXPECT_EQ(config.at("mesh").copy().at("file").where(), "in/beam.yaml:4:9: mesh.file");
}

TEST(Config, OnlyAResolvingCopyRecordsTheFilesThatItNames) {
  const Config plain = scene(), resolving = scene().resolving();
  for (const Config& config : {plain, resolving}) config.at("mesh").at("file").file_path();
  EXPECT_TRUE(plain.file_paths().empty());
  EXPECT_EQ(resolving.file_paths().size(), 1u);
}

TEST(Config, WhatIsSetReadsBackAsWhatItIs) {
  Config config = scene();
  config.set("new.number", 0.1);
  config.set("new.count", 3);
  config.set("new.flag", true);
  config.set("new.text", "a: b");
  config.set("new.list", std::vector<std::string>{"u", "v"});
  config.set("new.nothing", nullptr);
  config.set("new.mesh", config.at("mesh"));
  const Config section = Config::from_text(config.dump()).at("new");
  EXPECT_EQ(section.at("number").number(), 0.1);
  EXPECT_EQ(section.at("count").integer(), 3);
  EXPECT_TRUE(section.at("flag").boolean());
  EXPECT_EQ(section.at("text").text(), "a: b");
  EXPECT_EQ(section.at("list").at(1).text(), "v");
  EXPECT_TRUE(section.at("nothing").is_null());
  EXPECT_EQ(section.at("mesh").yaml(), config.at("mesh").yaml());
}

TEST(Config, WhatIsSetIsSaidToStandWhereItComesFrom) {
  Config config = scene();
  config.set("mesh.size", std::vector<std::string>{"1", "x", "3"}, "c.yaml:7:3: vary.size");
  EXPECT_EQ(refusal([&] { config.at("mesh").at("size").at(1).number(); }),
            "c.yaml:7:3: vary.size.1: expected a number, found 'x'");
  config.set("mesh", Config::from_text("{size: [1, 2]}"));
  EXPECT_EQ(config.at("mesh").at("size").at(1).where(), "in/beam.yaml: --set mesh.size.1");
  EXPECT_EQ(refusal([&] { config.set("mesh.size.5", 1.0, "c.yaml:8:3: vary.x"); }),
            "c.yaml:8:3: vary.x: '5' is not an index of the list; expected 0 to 1");
}

TEST(Config, AnErrorCarriesItsPlaceApartFromItsMessage) {
  try {
    scene().at("mesh").at("file").number();
    FAIL() << "accepted";
  } catch (const ConfigError& e) {
    EXPECT_EQ(e.place(), "in/beam.yaml:4:9: mesh.file");
    EXPECT_TRUE(e.message().starts_with("expected a number, found")) << e.message();
    EXPECT_EQ(e.what(), e.place() + ": " + e.message());
    EXPECT_EQ(e.fault(), InputFault::form);
  }
}

TEST(Config, AnAliasReadsAsWhatItNames) {
  const Config config = Config::from_text("a: &x {v: 3}\nb: *x\n");
  EXPECT_EQ(config.at("b").at("v").integer(), 3);
}

}  // namespace
}  // namespace orthodyn::config_test
