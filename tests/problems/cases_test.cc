// Every case in configs/cases meets its expectations.
#include <gtest/gtest.h>

#include <filesystem>

#include "lib/study/quantities/verify.h"

namespace orthodyn::study::cases_test {
namespace {

class Cases : public testing::TestWithParam<std::string> {};

TEST_P(Cases, MeetsItsExpectations) {
  const CaseResult result = verify(Config::from_file(GetParam()));
  EXPECT_EQ(result.outcome.message, "");
  for (const auto& check : result.checks)
    EXPECT_TRUE(check.passed()) << check.expectation.title() << ": computed " << check.computed << ", expected "
                                << check.expectation.value << " within " << check.expectation.limit();
}

INSTANTIATE_TEST_SUITE_P(Configs, Cases, testing::ValuesIn(find_cases({ORTHODYN_SOURCE_DIR "/configs/cases"})),
                         [](const auto& tested) { return std::filesystem::path(tested.param).stem().string(); });

}  // namespace
}  // namespace orthodyn::study::cases_test
