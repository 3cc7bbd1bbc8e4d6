#include "lib/core/utf8.h"

#include <gtest/gtest.h>

namespace orthodyn::utf8_test {
namespace {

constexpr auto kNone = std::string_view::npos;

TEST(Utf8, AcceptsCharactersOfEveryLength) {
  for (const char* text :
       {"", "plain", "Tr\u00e4ger", "\u20ac", "\U0001F333", "\u07FF\u0800\uFFFF\U00010000\U0010FFFF"})
    EXPECT_EQ(find_invalid_utf8(text), kNone) << text;
}

TEST(Utf8, FindsTheFirstByteThatIsNone) {
  EXPECT_EQ(find_invalid_utf8("ab\xE4"
                              "cd"),
            2u);                                 // Latin-1
  EXPECT_EQ(find_invalid_utf8("\x80"), 0u);      // continuation byte without a lead
  EXPECT_EQ(find_invalid_utf8("x\xC3"), 1u);     // truncated
  EXPECT_EQ(find_invalid_utf8("\xC0\xAF"), 0u);  // overlong
  EXPECT_EQ(find_invalid_utf8("\xE0\x80\xAF"), 0u);
  EXPECT_EQ(find_invalid_utf8("\xF0\x80\x80\xAF"), 0u);
  EXPECT_EQ(find_invalid_utf8("\xED\xA0\x80"), 0u);      // surrogate
  EXPECT_EQ(find_invalid_utf8("\xF4\x90\x80\x80"), 0u);  // beyond U+10FFFF
  EXPECT_EQ(find_invalid_utf8("\xFF"), 0u);
}

TEST(Utf8, Latin1BecomesUtf8) {
  EXPECT_EQ(utf8_from_latin1("Tr\xE4ger \xFF"), "Tr\u00e4ger \u00ff");
  std::string all;
  for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
  EXPECT_EQ(find_invalid_utf8(utf8_from_latin1(all)), kNone);
  EXPECT_EQ(utf8_from_latin1(all).size(), 384u);
}

}  // namespace
}  // namespace orthodyn::utf8_test
