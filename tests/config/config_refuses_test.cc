// Invalid YAML input, and the messages with which it is refused.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "lib/config/config.h"
#include "tests/config/messages.h"

namespace orthodyn::config_refuses_test {
namespace {

std::string refusal_of(const std::string& text) {
  return refusal([&] { Config::from_text(text, "a.yaml"); });
}

TEST(ConfigRefuses, AMissingFile) {
  EXPECT_EQ(refusal([] { Config::from_file("no/such.yaml"); }), "no/such.yaml: no such file");
}

TEST(ConfigRefuses, AFolder) {
  const std::string folder = std::filesystem::temp_directory_path().string();
  EXPECT_TRUE(holds(refusal([&] { Config::from_file(folder); }), "is a folder"));
}

TEST(ConfigRefuses, AnEmptyFile) {
  EXPECT_EQ(refusal_of(""), "a.yaml:1:1: the file is empty");
  EXPECT_EQ(refusal_of("# only a comment\n"), "a.yaml:1:1: the file is empty");
}

TEST(ConfigRefuses, WhatIsNotYamlWithItsLine) {
  const std::string message = refusal_of("a: 1\nb: 2\nc: *none\n");
  EXPECT_TRUE(starts(message, "a.yaml:3:"));
  EXPECT_TRUE(holds(message, "not YAML"));
}

// yaml-cpp itself reports the next line, the closing brace, or no error.
TEST(ConfigRefuses, AColonWithoutASpaceBehindIt) {
  EXPECT_EQ(refusal_of("mesh:\n  size:[1, 2]\n  cells: [1, 1]\n"), "a.yaml:2:3: not YAML: put a space after 'size:'");
  EXPECT_EQ(refusal_of("mesh: {type: box, size:[1, 2], a: 1}\n"), "a.yaml:1:19: not YAML: put a space after 'size:'");
  EXPECT_EQ(refusal_of("name:x\n\n# comment\nmesh: 1\n"), "a.yaml:1:1: not YAML: put a space after 'name:'");
  EXPECT_EQ(refusal_of("a: 1\ntime: {end:0.1}\n"), "a.yaml:2:8: put a space after 'end:'");
  EXPECT_TRUE(holds(refusal_of("clamps:[{surface: x0}]\n"), "put a space after 'clamps:'"));
}

TEST(ConfigRefuses, NoColonWithinATextOrAQuotedKey) {
  for (const char* text : {"a: b:c\n", "a: http://x.org\n", "'end:1': \n", "tip:1: {x: 2}\n", "a: [b:c, 12:30]\n"})
    EXPECT_EQ(refusal_of(text), "accepted") << text;
  EXPECT_FALSE(holds(refusal_of("a: b  # c:d\n {\n"), "put a space"));
}

TEST(ConfigRefuses, ALineThatIsIndentedBelowAValue) {
  EXPECT_TRUE(holds(refusal_of("mesh:\n  size: [1, 2]\n    cells: [1, 1]\n"),
                    "a.yaml:3:5: not YAML: this line is indented deeper"));
  EXPECT_TRUE(holds(refusal_of("mesh:\n\tsize: 1\n"), "indent with spaces, not tabs"));
}

// yaml-cpp itself reports a line after the bracket.
TEST(ConfigRefuses, ABracketThatNothingCloses) {
  EXPECT_EQ(refusal_of("a: 1\nb: [{c: 1}\nd: [3]\n"), "a.yaml:2:4: not YAML: this '[' is not closed");
  EXPECT_EQ(refusal_of("a: 1\nb: [{c: 1]\nd: 3\n"), "a.yaml:2:5: not YAML: this '{' is not closed");
  EXPECT_EQ(refusal_of("a: x[0  # [\nb: '['\nc: \"\\\"[\"\nd:\n  - [1, it's\ne: 3\n"),
            "a.yaml:5:5: not YAML: this '[' is not closed");
}

TEST(ConfigRefuses, NoBracketWhereAnotherThingIsWrong) {
  EXPECT_FALSE(holds(refusal_of("a: [1,\n  {b: 1}, 2]\nc: *none\n"), "is not closed"));
  EXPECT_FALSE(holds(refusal_of("c: *none\na: [1\n"), "is not closed"));
}

TEST(ConfigRefuses, SeveralDocuments) {
  EXPECT_TRUE(starts(refusal_of("a: 1\n---\nb: 2\n"), "a.yaml:2:1: more than one YAML document"));
}

TEST(ConfigRefuses, WhatFollowsTheDocument) {
  for (const char* text : {"{a: 1},", "[1, 2],", "{a: 1}, {b: 2}", "{a: 1}]", "{a: 1},\n\n"})
    EXPECT_TRUE(starts(refusal_of(text), "a.yaml:1:")) << text << ": " << refusal_of(text);
  EXPECT_NE(refusal([] { Config::from_text("a: 1").override_with("a={b: 1},"); }), "accepted");
}

TEST(ConfigRefuses, DeepNestingBeforeItIsBuilt) {
  for (const char* open : {"[", "{a: "}) {
    std::string text;
    for (int i = 0; i < 100'000; ++i) text += open;
    EXPECT_TRUE(starts(refusal_of(text), "a.yaml:1:")) << refusal_of(text);
  }
}

TEST(ConfigRefuses, WhatIsNotUtf8) {
  EXPECT_TRUE(starts(refusal_of("a: 1\nTr\xE4ger: 2\n"), "a.yaml:2:1: the byte 0xE4 is not UTF-8"));
  EXPECT_TRUE(starts(refusal_of("a: [1, \"\xFC\"]\n"), "a.yaml:1:8: the byte 0xFC"));
  EXPECT_EQ(refusal_of("a: 1  # f\xFCr\n"), "accepted");
}

TEST(Config, ReadsLinesThatEndWithCarriageReturns) {
  for (const char* end : {"\r\n", "\r"}) {
    const Config config = Config::from_text(std::string("a: 1") + end + "b: 2  # two" + end, "a.yaml");
    EXPECT_EQ(config.at("b").number(), 2);
  }
}

TEST(ConfigRefuses, AKeyGivenTwice) {
  EXPECT_EQ(refusal_of("a:\n  x: 1\n  y: 2\n  x: 3\n"),
            "a.yaml:4:3: key 'x' occurs twice in the same section; keep one");
}

TEST(ConfigRefuses, AKeyGivenTwiceInAnEntryOfAList) {
  EXPECT_TRUE(starts(refusal_of("- {x: 1, x: 2}\n"), "a.yaml:1:10: key 'x'"));
}

TEST(ConfigRefuses, MergeKeys) {
  EXPECT_TRUE(starts(refusal_of("a: &a {x: 1}\nb:\n  <<: *a\n"), "a.yaml:3:3: merge keys"));
}

TEST(ConfigRefuses, AKeyThatIsNotAWord) { EXPECT_TRUE(holds(refusal_of("[1, 2]: x\n"), "a key must be a plain word")); }

TEST(ConfigRefuses, AnAliasThatContainsItself) {
  EXPECT_TRUE(holds(refusal_of("a: &x\n  b: *x\n"), "alias that contains itself"));
}

TEST(ConfigRefuses, AliasesThatMultiplyWithoutEnd) {
  std::string text = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 9; ++k) text += last + ", ";
    text += last + "]\n";
  }
  EXPECT_TRUE(holds(refusal_of(text), "nested too deeply"));
}

TEST(ConfigRefuses, AnAliasWithoutAnAnchor) { EXPECT_TRUE(starts(refusal_of("a: *nothing\n"), "a.yaml:1:")); }

std::string number_refusal(const std::string& text) {
  return refusal([&] { Config::from_text(text, "a.yaml").number(); });
}

TEST(ConfigRefuses, NumbersThatAreNotFinite) {
  for (const char* text : {"nan", "inf", "-inf"})
    EXPECT_TRUE(holds(number_refusal(text), "expected a finite number")) << text;
}

TEST(ConfigRefuses, WhatIsNotANumber) {
  for (const char* text : {".nan", ".inf", "1e400", "1 2", "1,5", "0x10", "5 Pa", "--5", "+-5", "true", "''"})
    EXPECT_TRUE(holds(number_refusal(text), "expected a number, found '")) << text;
}

TEST(ConfigRefuses, ANumberInQuotesWhichIsAText) {
  for (const char* text : {"'5'", "\"-1e-3\""}) EXPECT_TRUE(holds(number_refusal(text), "remove the quotes")) << text;
  EXPECT_TRUE(holds(refusal([] { Config::from_text("'5'").integer(); }), "remove the quotes"));
  EXPECT_TRUE(holds(refusal([] { Config::from_text("\"true\"").boolean(); }), "remove the quotes"));
  EXPECT_EQ(Config::from_text("'5'").text(), "5");
}

TEST(ConfigRefuses, ASectionListOrNothingWhereANumberBelongs) {
  EXPECT_TRUE(holds(number_refusal("{a: 1}"), "found a section of keys"));
  EXPECT_TRUE(holds(number_refusal("[1, 2]"), "found a list of 2"));
  EXPECT_TRUE(holds(number_refusal("~"), "found nothing"));
}

TEST(ConfigRefuses, AFractionWhereAWholeNumberBelongs) {
  EXPECT_TRUE(holds(refusal([] { Config::from_text("1.5").integer(); }), "expected a whole number"));
  EXPECT_TRUE(holds(refusal([] { Config::from_text("1e16").integer(); }), "expected a whole number"));
}

TEST(ConfigRefuses, AnythingButTrueAndFalseAsABoolean) {
  for (const char* text : {"yes", "1", "True", "[true]"})
    EXPECT_TRUE(holds(refusal([&] { Config::from_text(text).boolean(); }), "expected true or false"));
}

TEST(ConfigRefuses, AListWhereATextBelongs) {
  EXPECT_TRUE(holds(refusal([] { Config::from_text("[a]").text(); }), "expected a text"));
}

}  // namespace
}  // namespace orthodyn::config_refuses_test
