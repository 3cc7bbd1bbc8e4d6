// Sections with declared keys: defaults, required keys, conditions and unknown keys.
#include "lib/config/spec.h"

#include <gtest/gtest.h>

#include <optional>

#include "tests/config/messages.h"

namespace orthodyn::spec_test {
namespace {

struct Step {
  double first = 1e-3;
  int most = 1000;
  static const Spec<Step>& spec() {
    static const auto s = Spec<Step>()
                              .key("first", &Step::first, "First step.", {.unit = "s", .range = kPositive})
                              .key("most", &Step::most, "Most steps.");
    return s;
  }
};

struct Solver {
  double rtol = 0.1;
  std::string name;
  Step step;
  std::optional<double> limit;
  Vec3 axis{1, 0, 0.1};
  SourceLocation origin;

  static const Spec<Solver>& spec() {
    static const auto s = Spec<Solver>()
                              .key("rtol", &Solver::rtol, "Tolerance.", {.range = {0, 1, true, true}})
                              .key("name", &Solver::name, "A name.", {.required = true, .unit = "any"})
                              .key("step", &Solver::step, "Steps.")
                              .key("limit", &Solver::limit, "A limit.", {.range = kPositive})
                              .key("axis", &Solver::axis, "An axis.")
                              .check([](const Solver& solver, const Config& config) {
                                if (solver.limit && *solver.limit < solver.step.first)
                                  config.fail("limit below step.first");
                              });
    return s;
  }
};

std::string refusal_of(const std::string& text) {
  return refusal([&] { Solver::spec().read(Config::from_text(text, "a.yaml")); });
}

TEST(Spec, GivenKeysAreRead) {
  const Solver s = Solver::spec().read(Config::from_text("{name: x, rtol: 0.5, limit: 2, axis: [0, 0, 1]}"));
  EXPECT_EQ(s.name, "x");
  EXPECT_EQ(s.rtol, 0.5);
  EXPECT_EQ(s.limit, 2);
  EXPECT_EQ(s.axis, Vec3(0, 0, 1));
}

TEST(Spec, AbsentKeysKeepTheDefaultOfTheStruct) {
  const Solver s = Solver::spec().read(Config::from_text("{name: x}"));
  EXPECT_EQ(s.rtol, Solver{}.rtol);
  EXPECT_EQ(s.step.most, Step{}.most);
  EXPECT_EQ(s.limit, std::nullopt);
}

TEST(Spec, ANullCountsAsAbsent) {
  const Solver s = Solver::spec().read(Config::from_text("{name: x, rtol: ~, limit: }"));
  EXPECT_EQ(s.rtol, Solver{}.rtol);
  EXPECT_EQ(s.limit, std::nullopt);
}

TEST(Spec, DefaultsTakenAreFilledIntoTheDump) {
  const Config config = Config::from_text("{name: x, step: {most: 5}}").resolving();
  Solver::spec().read(config);
  const Config resolved = Config::from_text(config.dump());
  EXPECT_EQ(resolved.at("rtol").number(), Solver{}.rtol);
  EXPECT_EQ(resolved.at("step").at("first").number(), Step{}.first);
  EXPECT_EQ(resolved.at("axis").at(2).number(), 0.1);
  EXPECT_FALSE(resolved.has("limit"));
}

TEST(Spec, ReadingLeavesTheDocumentAsItIs) {
  const Config config = Config::from_text("{name: x, step: {most: 5}}");
  const std::string before = config.dump();
  const Solver plain = Solver::spec().read(config), resolved = Solver::spec().read(config.resolving());
  EXPECT_EQ(config.dump(), before);
  EXPECT_FALSE(config.has("rtol"));
  EXPECT_EQ(plain.rtol, resolved.rtol);
  EXPECT_EQ(plain.step.first, resolved.step.first);
}

TEST(Spec, TheDumpReadsBackToTheSameValuesAndDump) {
  const Config config = Config::from_text("{name: x}").resolving();
  const Solver first = Solver::spec().read(config);
  const Config resolved = Config::from_text(config.dump());
  const Solver second = Solver::spec().read(resolved);
  EXPECT_EQ(second.axis, first.axis);
  EXPECT_EQ(second.step.first, first.step.first);
  EXPECT_EQ(resolved.dump(), config.dump());
}

TEST(Spec, AnUnknownKeyIsRefusedWithItsPlaceAndTheNearestName) {
  const std::string message = refusal_of("name: x\nrtoll: 1\n");
  EXPECT_TRUE(starts(message, "a.yaml:2:8: rtoll: unknown key; did you mean 'rtol'?"));
  EXPECT_TRUE(holds(message, "Known here: rtol, name, step, limit, axis."));
}

TEST(Spec, AnUnknownKeyFarFromAllNamesComesWithoutASuggestion) {
  EXPECT_FALSE(holds(refusal_of("name: x\ngravitation: 1\n"), "did you mean"));
}

TEST(Spec, AnUnknownKeyIsRefusedInNestedSections) {
  EXPECT_TRUE(starts(refusal_of("name: x\nstep:\n  frist: 1\n"), "a.yaml:3:10: step.frist: unknown key"));
}

TEST(Spec, AKeyOfASectionBesideItBelongsBelowThat) {
  EXPECT_TRUE(holds(refusal_of("name: x\nmost: 3\n"), "unknown key; it belongs below 'step': indent it. Known here"));
  EXPECT_TRUE(holds(refusal_of("name: x\nstep:\nfirst: 3\n"), "it belongs below 'step'"));
}

TEST(Spec, AKeyOfTheSectionAroundBelongsBesideIt) {
  EXPECT_EQ(refusal_of("name: x\nstep: {most: 1, rtol: 0.5}\n"),
            "a.yaml:2:23: step.rtol: unknown key; it belongs beside 'step', not below: indent it less. Known here: "
            "first, most.");
}

TEST(Spec, AScalarThatIsAKeyAndItsValueLacksASpace) {
  EXPECT_TRUE(holds(refusal_of("name: x\nstep:\n  most:3\n"), "found 'most:3'; put a space after 'most:'"));
}

TEST(Spec, AMissingRequiredKeyIsNamedWithTypeAndUnit) {
  EXPECT_TRUE(holds(refusal_of("{rtol: 0.5}"), "key 'name' is missing (text, any)"));
}

TEST(Spec, AScalarInPlaceOfASectionIsRefusedWithTheKnownKeys) {
  EXPECT_EQ(refusal_of("name: x\nstep: 3\n"), "a.yaml:2:7: step: expected a section of keys (first, most), found '3'");
}

TEST(Spec, AConditionOfSeveralKeysIsChecked) {
  EXPECT_TRUE(holds(refusal_of("{name: x, limit: 1e-4}"), "limit below step.first"));
}

TEST(Spec, TheOriginIsThePlaceOfTheSection) {
  EXPECT_EQ(Solver::spec().read(Config::from_text("\n{name: x}", "a.yaml")).origin.where, "a.yaml:2:1");
}

TEST(Spec, KeysAreDescribedWithTypeUnitRangeAndDefault) {
  const auto& keys = Solver::spec().keys();
  EXPECT_EQ(type_text(keys[0].schema), "number");
  EXPECT_EQ(range_text(keys[0].range), "in (0, 1)");
  EXPECT_EQ(keys[0].fallback, "0.1");
  EXPECT_EQ(keys[0].sentence, "Tolerance.");
  EXPECT_TRUE(keys[1].required);
  EXPECT_EQ(keys[1].fallback, "");
  EXPECT_EQ(keys[4].fallback, "[1, 0, 0.1]");
}

struct Outer {
  struct Inner {
    double value = 0;
    static const Spec<Inner>& spec() {
      static const auto s = Spec<Inner>().key("value", &Inner::value, "Needed.", {.required = true});
      return s;
    }
  };
  Inner inner;
  static const Spec<Outer>& spec() {
    static const auto s = Spec<Outer>().key("inner", &Outer::inner, "A section.");
    return s;
  }
};

TEST(Spec, ARequiredKeyOfAnAbsentSectionIsReportedWithoutAFalseLine) {
  const Config config = Config::from_text("a:\n  b:\n    {}\n", "a.yaml");
  EXPECT_EQ(refusal([&] { Outer::spec().read(config.at("a").at("b")); }),
            "a.yaml: a.b.inner: key 'value' is missing (number)");
}

struct Journey {
  std::string by = "train";
  double fuel = 40;
  static const Spec<Journey>& spec() {
    static const auto s =
        Spec<Journey>().key("by", &Journey::by, "How.").key("fuel", &Journey::fuel, "Litres.", {.with = {"by", "car"}});
    return s;
  }
};

struct Renamed {
  double metric = 1;
  static const Spec<Renamed>& spec() {
    static const auto s = Spec<Renamed>().key("metric", &Renamed::metric, "A number.").rename("figure", "metric");
    return s;
  }
};

TEST(Spec, AFormerKeyIsReadAsTheNewOneWithAWarning) {
  const Config config = Config::from_text("figure: 3", "a.yaml").resolving();
  EXPECT_EQ(Renamed::spec().read(config).metric, 3);
  ASSERT_EQ(config.warnings().size(), 1u);
  EXPECT_TRUE(starts(config.warnings()[0], "a.yaml:1:9: figure: is now called 'metric'")) << config.warnings()[0];
  EXPECT_EQ(Config::from_text(config.dump()).keys(), std::vector<std::string>{"metric"});
}

TEST(Spec, AFormerKeyBesideTheNewOneIsRefused) {
  const std::string message =
      refusal([] { Renamed::spec().read(Config::from_text("{figure: 3, metric: 2}", "a.yaml")); });
  EXPECT_TRUE(holds(message, "'metric'")) << message;
}

TEST(Spec, AKeyThatMeansSomethingWithAnotherAloneIsNeitherTakenNorFilledInElsewhere) {
  const Config car = Config::from_text("by: car").resolving(), train = Config::from_text("by: train").resolving();
  Journey::spec().read(car);
  Journey::spec().read(train);
  EXPECT_TRUE(car.has("fuel"));
  EXPECT_FALSE(train.has("fuel"));
  EXPECT_EQ(Journey::spec().read(Config::from_text("{by: car, fuel: 3}")).fuel, 3);
  const std::string message = refusal([] { Journey::spec().read(Config::from_text("{fuel: 3}", "a.yaml")); });
  EXPECT_TRUE(starts(message, "a.yaml:1:8: fuel: applies only with by: car, found by: train")) << message;
}

}  // namespace
}  // namespace orthodyn::spec_test
