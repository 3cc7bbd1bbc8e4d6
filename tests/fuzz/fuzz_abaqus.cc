#include "lib/mesh/io/abaqus.h"
#include "tests/fuzz/only_refuses.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return orthodyn::only_refuses(data, size,
                                [](std::string_view text) { orthodyn::read_abaqus_text("/nowhere/fuzz.inp", text); });
}
