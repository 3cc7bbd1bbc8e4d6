// The program orthodyn. Its commands are in the other files of this folder and register themselves (command.h).
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
#include "tools/orthodyn/on_ranks.h"
#include "tools/orthodyn/plugins.h"
#include "tools/orthodyn/print_nothrow.h"

namespace {

// OpenBLAS starts its threads when it is loaded, and hangs if the address space is too small for them (ulimit -v). If
// the address space is limited, the program restarts itself with one thread.
void start_with_one_blas_thread_if_addresses_are_limited(char** argv) {
  constexpr const char* kThreads = "OPENBLAS_NUM_THREADS";
  const char* threads = std::getenv(kThreads);
  if (!orthodyn::address_space_is_limited() || (threads && std::strcmp(threads, "1") == 0)) return;
  setenv(kThreads, "1", 1);
  execv("/proc/self/exe", argv);  // returns only on failure: then continues with all threads
}

int print_answer(const orthodyn::Answer& answer) {
  if (answer.exit_code != 0) orthodyn::let_first_rank_report();
  std::cout << answer.out;
  orthodyn::print_nothrow(answer.err);
  return answer.exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace orthodyn;
  start_with_one_blas_thread_if_addresses_are_limited(argv);
#ifdef __GLIBC__
  // Memory that one step frees is kept for the next, up to 32 MB. Asking the system for it again takes a fifth of the
  // time of short runs; returning blocks of 1 MB saves 4 % of the memory at 84,000 elements.
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 32 << 20);
#endif
  wait_for_sigterm();
  end_with_parent_if_asked();
  try {
    const CommandLine line = parse_command_line(argc, argv);
    if (!line.answer) {
      require_one_rank_unless(line.on_ranks, line.name);
      load_plugins(line.plugins);
    }
    const int code = line.answer ? print_answer(*line.answer) : line.run();
    // Buffered output may fail as late as here.
    std::cout.flush();
    if (!std::cout || std::fflush(stdout) != 0)
      throw RunError(fmt::format("cannot write to the standard output: {}", std::strerror(errno)));
    return code;
  } catch (const ConfigError& e) {
    return print_answer({2, "", fmt::format("error: {}\n", e.what())});
  } catch (const std::bad_alloc&) {
    return print_answer({3, "", "error: out of memory; use a coarser mesh\n"});
  } catch (const std::exception& e) {
    return print_answer({3, "", fmt::format("error: {}\n", e.what())});
  }
}
