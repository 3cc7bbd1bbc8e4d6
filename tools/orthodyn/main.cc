// orthodyn: the program. Its commands are in the files beside this one, each registered by itself (command.h).
#include <fmt/format.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>

#include "lib/core/errors.h"
#include "tools/orthodyn/command_line.h"
#include "tools/orthodyn/notice.h"
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
    const int code = line.run();
    // What is printed may wait in a buffer until here.
    if (std::fflush(stdout) != 0)
      throw RunError(fmt::format("cannot write to the standard output: {}", std::strerror(errno)));
    return code;
  } catch (const ConfigError& e) {
    print_notice(fmt::format("error: {}\n", e.what()));
    return 2;
  } catch (const std::bad_alloc&) {
    print_notice("error: out of memory; use a coarser mesh\n");
    return 3;
  } catch (const std::exception& e) {
    print_notice(fmt::format("error: {}\n", e.what()));
    return 3;
  }
}
