// orthodyn: the program. Its commands are in the files beside this one, each registered by itself (command.h).
#include <fmt/format.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <new>

#include "lib/core/errors.h"
#include "tools/orthodyn/command_line.h"
#include "tools/orthodyn/plugins.h"

int main(int argc, char** argv) {
  using namespace orthodyn;
#ifdef __GLIBC__
  // Large blocks go back to the system when freed: a fifth less memory at 84,000 elements.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
  const CommandLine line = parse_command_line(argc, argv);
  if (line.exit_code) return *line.exit_code;
  try {
    load_plugins(line.plugins);
    return line.run();
  } catch (const ConfigError& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 2;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: out of memory; use a coarser mesh\n");
    return 3;
  } catch (const std::exception& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 3;
  }
}
