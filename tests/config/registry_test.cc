// The registry: objects chosen by the key `type`.
#include "lib/config/registry.h"

#include <gtest/gtest.h>

#include "tests/config/messages.h"

namespace orthodyn::registry_test {
namespace {

struct Shape {
  virtual ~Shape() = default;
  virtual double area() const = 0;
};

struct Square : Shape {
  double side = 1;
  double area() const override { return side * side; }
  static const Spec<Square>& spec() {
    static const auto s =
        Spec<Square>().key("side", &Square::side, "Length of a side.", {.required = true, .range = kPositive});
    return s;
  }
};

struct Disc : Shape {
  double radius = 1;
  double area() const override { return 3.14 * radius * radius; }
  static const Spec<Disc>& spec() {
    static const auto s = Spec<Disc>().key("radius", &Disc::radius, "Radius.");
    return s;
  }
};

const bool square = Registry<Shape>::add<Square>("square", "Four equal sides.");
const bool disc = Registry<Shape>::add<Disc>("disc", "Round.");
const bool circle = Registry<Shape>::rename("circle", "disc");

Config text(const std::string& yaml) { return Config::from_text(yaml, "a.yaml"); }

std::string refusal_of(const std::string& yaml) {
  return refusal([&] { Registry<Shape>::read(text(yaml)); });
}

TEST(Registry, TheTypeChoosesWhatIsBuilt) {
  EXPECT_EQ(Registry<Shape>::read(text("{type: square, side: 3}"))->area(), 9);
  EXPECT_EQ(Registry<Shape>::read(text("{type: disc, radius: 10}"))->area(), 314);
}

TEST(Registry, ANameIsTakenOnce) {
  EXPECT_TRUE(square && disc);
  EXPECT_FALSE(Registry<Shape>::add<Disc>("square", "Another."));
}

TEST(Registry, AnUnknownTypeIsRefusedWithTheNearestAndAllNames) {
  EXPECT_EQ(refusal_of("side: 3\ntype: sqare\n"),
            "a.yaml:2:7: type: unknown 'sqare'; did you mean 'square'? Known: disc, square.");
}

TEST(Registry, AMissingTypeIsRefusedWithAllNames) {
  EXPECT_EQ(refusal_of("side: 3"), "a.yaml:1:1: key 'type' is missing; one of disc, square");
}

TEST(Registry, AnEmptyTypeIsRefused) {
  EXPECT_TRUE(holds(refusal_of("type:"), "type: expected a text, found nothing"));
}

TEST(Registry, AScalarIsRefusedWithAllNames) {
  EXPECT_TRUE(holds(refusal_of("square"), "expected a section with the key 'type' (disc, square), found 'square'"));
}

TEST(Registry, KeysOfTheOtherTypesAreUnknown) {
  EXPECT_TRUE(holds(refusal_of("{type: disc, side: 1}"), "side: unknown key"));
}

TEST(Registry, KeysAreListedWithEachName) {
  const auto& entries = Registry<Shape>::entries();
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries.at("square").sentence, "Four equal sides.");
  ASSERT_EQ(entries.at("square").keys.size(), 1u);
  EXPECT_EQ(entries.at("square").keys[0].name, "side");
  EXPECT_EQ(range_text(entries.at("square").keys[0].range), "> 0");
}

TEST(Registry, TheDefaultOfAChosenTypeIsFilledIn) {
  const Config config = text("{type: disc}").resolving();
  Registry<Shape>::read(config);
  EXPECT_EQ(text(config.dump()).at("radius").number(), 1);
}

TEST(Registry, AFormerNameIsReadAsTheNewOneWithAWarning) {
  const Config config = text("{type: circle, radius: 10}").resolving();
  EXPECT_EQ(Registry<Shape>::read(config)->area(), 314);
  ASSERT_EQ(config.warnings().size(), 1u);
  EXPECT_TRUE(starts(config.warnings()[0], "a.yaml:1:8: type: 'circle' is now called 'disc'"));
  EXPECT_EQ(text(config.dump()).at("type").text(), "disc");
}

TEST(Registry, AMemberIsReadThroughTheRegistry) {
  const auto shape = Value<std::shared_ptr<const Shape>>::read(text("{type: square, side: 2}"), {});
  EXPECT_EQ(shape->area(), 4);
}

}  // namespace
}  // namespace orthodyn::registry_test
