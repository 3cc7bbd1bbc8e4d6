#include "lib/mesh/io/tetgen.h"
#include "tests/fuzz/only_refuses.h"

// An input is the text of the three TetGen files, separated by lines "%%".
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return orthodyn::only_refuses(data, size, [](std::string_view text) {
    constexpr std::string_view kBetween = "%%\n";
    const std::size_t first = std::min(text.find(kBetween), text.size());
    const std::string_view rest = text.substr(std::min(first + kBetween.size(), text.size()));
    const std::size_t second = std::min(rest.find(kBetween), rest.size());
    orthodyn::read_tetgen_text("/nowhere/fuzz", {text.substr(0, first), rest.substr(0, second),
                                                 rest.substr(std::min(second + kBetween.size(), rest.size()))});
  });
}
