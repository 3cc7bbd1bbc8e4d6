// Fingerprints of different texts differ, and do not depend on how a text is divided into pieces.
#include "lib/core/fingerprint.h"

#include <gtest/gtest.h>

namespace orthodyn::fingerprint_test {
namespace {

TEST(Fingerprint, OfATextInPiecesIsThatOfTheText) {
  const std::string text = "t [s],x [m]\n0,1.5\n";
  const std::string_view view = text;
  for (std::size_t cut = 0; cut <= text.size(); ++cut)
    EXPECT_EQ(Fingerprint().add_piece(view.substr(0, cut)).add_piece(view.substr(cut)).text(),
              Fingerprint().add_piece(text).text());
}

TEST(Fingerprint, OfTextsThatAreAddedKnowsWhereOneEnds) {
  EXPECT_NE(Fingerprint().add("ab").add("c").text(), Fingerprint().add("a").add("bc").text());
}

TEST(Fingerprint, ItsNumberChangesWithEveryBit) {
  std::string text(200, 'x');
  for (std::size_t k = 0; k < text.size(); ++k) text[k] = static_cast<char>(k);
  const double number = Fingerprint().add_piece(text).number();
  EXPECT_EQ(number, Fingerprint().add_piece(text).number());
  for (std::size_t k = 0; k < text.size(); ++k)
    for (int bit = 0; bit < 8; ++bit) {
      text[k] ^= static_cast<char>(1 << bit);
      EXPECT_NE(Fingerprint().add_piece(text).number(), number) << k << " " << bit;
      text[k] ^= static_cast<char>(1 << bit);
    }
}

}  // namespace
}  // namespace orthodyn::fingerprint_test
