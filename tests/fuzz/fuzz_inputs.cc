// Fuzzer of scenes and studies. An input is the path of a shipped file, a line break, and a text that replaces the
// content of this file. No seeds are needed: one mutation in eight starts again from a shipped file.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "tests/fuzz/input_check.h"
#include "tests/fuzz/mutation.h"

namespace {

using orthodyn::InputFileText;

const std::vector<InputFileText>& shipped() {
  static const auto all = orthodyn::shipped_inputs();
  return all;
}

const std::vector<std::string>& words() {
  static const auto all = [] {
    std::vector<std::string> out;
    for (const auto& input : shipped())
      for (auto& word : orthodyn::words_of(input.text)) out.push_back(std::move(word));
    return out;
  }();
  return all;
}

InputFileText split(const std::uint8_t* data, std::size_t size) {
  const std::string_view all(reinterpret_cast<const char*>(data), size);
  const auto end = std::min(all.find('\n'), all.size());
  return {std::string(all.substr(0, end)), std::string(all.substr(std::min(end + 1, all.size())))};
}

bool is_shipped(const std::string& path) {
  for (const auto& input : shipped())
    if (input.path == path) return true;
  return false;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  orthodyn::limit_memory_of_meshes();
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  std::mt19937 random(seed);
  InputFileText input = split(data, size);
  if (!is_shipped(input.path) || random() % 8 == 0) input = shipped()[random() % shipped().size()];
  input.text = random() % 4 == 0 ? orthodyn::with_mutated_bytes(input.text, random)
                                 : orthodyn::with_mutated_tree(input.text, words(), random);
  const std::string whole = input.path + "\n" + input.text;
  size = std::min(whole.size(), max_size);
  std::memcpy(data, whole.data(), size);
  return size;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const InputFileText input = split(data, size);
  if (!is_shipped(input.path)) return -1;  // do not add it to the corpus
  const auto [verdict, message] = orthodyn::judge(input);
  if (verdict != orthodyn::Verdict::bug) return 0;
  std::fprintf(stderr, "%s ended with\n%s\n", input.path.c_str(), message.c_str());
  std::abort();
}
