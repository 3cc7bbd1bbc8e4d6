// Every case in configs/cases meets its expectations, and so do hard cases of assemblies.
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

std::vector<std::string> hard(const std::vector<std::string>& names) {
  std::vector<std::string> out;
  for (const auto& name : names) out.push_back(ORTHODYN_SOURCE_DIR "/configs/stability/cases/" + name + ".yaml");
  return out;
}

// Hard cases with joints and contact, with the integrator of the scene.
INSTANTIATE_TEST_SUITE_P(HardAssemblies, Cases,
                         testing::ValuesIn(hard({"hits_a_stop", "fly_on_an_anvil", "through_dead_centre",
                                                 "locked_mechanism", "edge_on_edge", "fast_at_a_thin_plate"})),
                         [](const auto& tested) { return std::filesystem::path(tested.param).stem().string(); });
INSTANTIATE_TEST_SUITE_P(HardTower, Cases, testing::ValuesIn(hard({"tower"})),
                         [](const auto& tested) { return std::filesystem::path(tested.param).stem().string(); });

}  // namespace
}  // namespace orthodyn::study::cases_test
