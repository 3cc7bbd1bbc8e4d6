// Damaged scenes and studies must be accepted, or refused with a message that names a place. Uses the mutations of the
// fuzzer fuzz_inputs (CMakeLists.txt), with few inputs and fixed seeds.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/fuzz/input_check.h"
#include "tests/fuzz/mutation.h"

namespace orthodyn::mutated_inputs_test {
namespace {

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

// Ends the process after this time of computation; 0: no limit.
void limit_cpu_seconds(int seconds) {
  const itimerval timer{{0, 0}, {seconds, 0}};
  setitimer(ITIMER_PROF, &timer, nullptr);
}

std::vector<std::string> all_words() {
  std::vector<std::string> out;
  for (const auto& input : shipped_inputs())
    for (auto& word : words_of(input.text)) out.push_back(std::move(word));
  return out;
}

// The number of inputs per seed.
int number_of_inputs() {
  const char* given = std::getenv("ORTHODYN_MUTATED_INPUTS");
  return given ? std::atoi(given) : 700;
}

class MutatedInputs : public testing::TestWithParam<unsigned> {
 protected:
  MutatedInputs() { limit_memory_of_meshes(); }
};

// If an input crashes the process or computes for longer than a minute, its text is left in the folder of temporary
// files.
TEST_P(MutatedInputs, AreAcceptedOrRefusedWithAPlace) {
  const auto shipped = shipped_inputs();
  const auto words = all_words();
  ASSERT_GT(shipped.size(), 100u);
  std::mt19937 random(GetParam());
  const auto current = std::filesystem::temp_directory_path() / ("orthodyn_mutated_" + std::to_string(getpid()));
  int accepted = 0, refused = 0;
  const int inputs = number_of_inputs();
  for (int i = 0; i < inputs; ++i) {
    InputFileText input = shipped[random() % shipped.size()];
    input.text =
        random() % 4 == 0 ? with_mutated_bytes(input.text, random) : with_mutated_tree(input.text, words, random);
    std::ofstream(current, std::ios::binary) << input.text;
    limit_cpu_seconds(60);
    const auto [verdict, message] = judge(input);
    limit_cpu_seconds(0);
    accepted += verdict == Verdict::accepted;
    refused += verdict == Verdict::refused;
    EXPECT_NE(verdict, Verdict::bug) << input.path << " ended with\n" << message << "\n" << input.text;
  }
  std::filesystem::remove(current);
  EXPECT_GT(accepted, inputs / 20);
  EXPECT_GT(refused, inputs / 4);
  EXPECT_LT(peak_bytes(), 2e9);
}

INSTANTIATE_TEST_SUITE_P(Seeds, MutatedInputs, testing::Range(1u, 9u));

}  // namespace
}  // namespace orthodyn::mutated_inputs_test
