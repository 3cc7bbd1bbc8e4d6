// Explanations of failures by their cause.
#include "lib/core/cause.h"

#include <gtest/gtest.h>

namespace orthodyn::cause_test {
namespace {

TEST(Causes, OfALimitStandAlone) {
  Cause cause;
  EXPECT_EQ(cause.explain("the force cannot be evaluated", "; lower the step"),
            "the force cannot be evaluated; lower the step");
  cause.note(RecoverableError("a spring has zero length"));
  EXPECT_EQ(cause.explain("the force cannot be evaluated", "; lower the step"),
            "the force cannot be evaluated (a spring has zero length); lower the step");
  EXPECT_FALSE(cause.is_limit());
  cause.note(LimitError("scene.yaml:9", "nodes touch that are too far apart: raise `slide`"));
  EXPECT_TRUE(cause.is_limit());
  EXPECT_EQ(cause.explain("the force cannot be evaluated", "; lower the step"),
            "scene.yaml:9: nodes touch that are too far apart: raise `slide`");
  cause.clear();
  EXPECT_TRUE(cause.empty());
  EXPECT_FALSE(cause.is_limit());
}

}  // namespace
}  // namespace orthodyn::cause_test
