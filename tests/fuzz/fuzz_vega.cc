#include "lib/mesh/io/vega.h"
#include "tests/fuzz/only_refuses.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return orthodyn::only_refuses(data, size,
                                [](std::string_view text) { orthodyn::read_vega_text("/nowhere/fuzz.veg", text); });
}
