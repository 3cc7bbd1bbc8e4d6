#include <gtest/gtest.h>

#include "lib/config/spec.h"
#include "lib/config/values.h"
#include "tests/config/messages.h"

namespace orthodyn::auto_or_test {
namespace {

struct Stepping {
  AutoOr<double> step;
  static const Spec<Stepping>& spec() {
    static const auto s = Spec<Stepping>().key("step", &Stepping::step, "Step.", {.unit = "s", .range = kPositive});
    return s;
  }
};

std::optional<double> step_of(const std::string& yaml) {
  return Stepping::spec().read(Config::from_text(yaml, "a.yaml")).step.value;
}

std::string refusal_of(const std::string& yaml) {
  return refusal([&] { step_of(yaml); });
}

TEST(AutoOr, ReadsANumberWithOrWithoutItsUnitOrTheWord) {
  EXPECT_EQ(step_of("{step: 0.002}"), 0.002);
  EXPECT_EQ(step_of("{step: 2 ms}"), 0.002);
  EXPECT_EQ(step_of("{step: auto}"), std::nullopt);
  EXPECT_EQ(step_of("{}"), std::nullopt);
}

TEST(AutoOr, ChecksTheNumbersRangeAndUnit) {
  EXPECT_NE(refusal_of("{step: 0}").find("must be > 0 s"), std::string::npos) << refusal_of("{step: 0}");
  EXPECT_NE(refusal_of("{step: 2 m}").find("a.yaml:1:"), std::string::npos) << refusal_of("{step: 2 m}");
}

TEST(AutoOr, NamesTheWordThatWasMeant) {
  EXPECT_NE(refusal_of("{step: atuo}").find("did you mean 'auto'?"), std::string::npos) << refusal_of("{step: atuo}");
}

TEST(AutoOr, SaysWhatMayStandThere) {
  EXPECT_EQ(type_text(Stepping::spec().keys().front().schema), "number, or auto");
  EXPECT_EQ(Stepping::spec().keys().front().fallback, "auto");
}

}  // namespace
}  // namespace orthodyn::auto_or_test
