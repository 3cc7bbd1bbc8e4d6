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

int tell(const orthodyn::Answer& answer) {
  if (answer.exit_code != 0) orthodyn::let_first_rank_tell();
  std::cout << answer.out;
  orthodyn::print_notice(answer.err);
  return answer.exit_code;
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
    if (!line.answer) {
      require_one_rank_unless(line.on_ranks, line.name);
      load_plugins(line.plugins);
    }
    const int code = line.answer ? tell(*line.answer) : line.run();
    // What is printed may wait in a buffer until here.
    std::cout.flush();
    if (!std::cout || std::fflush(stdout) != 0)
      throw RunError(fmt::format("cannot write to the standard output: {}", std::strerror(errno)));
    return code;
  } catch (const ConfigError& e) {
    return tell({2, "", fmt::format("error: {}\n", e.what())});
  } catch (const std::bad_alloc&) {
    return tell({3, "", "error: out of memory; use a coarser mesh\n"});
  } catch (const std::exception& e) {
    return tell({3, "", fmt::format("error: {}\n", e.what())});
  }
}
