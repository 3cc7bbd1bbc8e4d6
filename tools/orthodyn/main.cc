// orthodyn: the program. Its commands are in the files beside this one, each registered by itself (command.h).
#include <fmt/format.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <new>

#include "lib/core/errors.h"
#include "lib/core/memory.h"
#include "tools/orthodyn/command_line.h"
#include "tools/orthodyn/interrupt.h"
#include "tools/orthodyn/notice.h"
#include "tools/orthodyn/on_ranks.h"
#include "tools/orthodyn/plugins.h"

namespace {

// OpenBLAS makes its threads when it is loaded, and waits for ever for memory that they cannot have: where addresses
// are limited the program starts again with one.
void start_with_one_blas_thread_if_addresses_are_limited(char** argv) {
  constexpr const char* kThreads = "OPENBLAS_NUM_THREADS";
  const char* threads = std::getenv(kThreads);
  if (!orthodyn::addresses_are_limited() || (threads && std::strcmp(threads, "1") == 0)) return;
  setenv(kThreads, "1", 1);
  execv("/proc/self/exe", argv);  // returns only where it fails; then with as many threads as there are
}

}  // namespace

int main(int argc, char** argv) {
  using namespace orthodyn;
  start_with_one_blas_thread_if_addresses_are_limited(argv);
#ifdef __GLIBC__
  // Large blocks go back to the system when freed: a fifth less memory at 84,000 elements.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
  wait_for_sigterm();
  end_with_parent_if_asked();
  try {
    const CommandLine line = parse_command_line(argc, argv);
    const std::optional<Answer> answer = line.answer ? line.answer : refusal_on_ranks(line);
    if (!answer) load_plugins(line.plugins);
    const int code = answer ? tell_once(*answer) : line.run();
    // What is printed may wait in a buffer until here.
    std::cout.flush();
    if (!std::cout || std::fflush(stdout) != 0)
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
