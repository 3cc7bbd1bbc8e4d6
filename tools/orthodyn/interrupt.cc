#include "tools/orthodyn/interrupt.h"

#include <pthread.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <thread>

namespace orthodyn {

namespace {

constexpr unsigned kSecondsToEnd = 4;  // less than the 5 s after which mpirun kills its ranks (mpirun.h)

std::atomic<bool> flag{false};
std::atomic<bool> catches_sigterm{false};

sigset_t only_sigterm() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGTERM);
  return set;
}

// SIGTERM is blocked in every thread, so that no library's handler runs. This must happen before libraries are
// initialised: OpenBLAS starts threads then, and they inherit the mask.
void block_sigterm(int, char**, char**) {
  const sigset_t term = only_sigterm();
  pthread_sigmask(SIG_BLOCK, &term, nullptr);
}
[[gnu::section(".preinit_array"), gnu::used]] void (*block_before_all_else)(int, char**, char**) = block_sigterm;

void request_end() {
  flag = true;
  alarm(kSecondsToEnd);
}

void on_signal(int signal) {
  std::signal(signal, signal == SIGHUP ? SIG_IGN : SIG_DFL);  // shell and kernel may both send SIGHUP
  request_end();
}

void end_by_sigterm() {
  std::signal(SIGTERM, SIG_DFL);
  const sigset_t term = only_sigterm();
  pthread_sigmask(SIG_UNBLOCK, &term, nullptr);
  std::raise(SIGTERM);
}

// Uses only functions that are safe in a signal handler. Child processes end with this one (process.cc); files are
// complete at any time, or truncated by --resume.
void end_at_once(int) {
  static constexpr char kText[] =
      "\ninterrupted: ended after 4 s in the middle of a computation; files written so far are kept\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kText, sizeof kText - 1);
  _exit(130);
}

bool is_ignored(int signal) {
  struct sigaction now {};
  sigaction(signal, nullptr, &now);
  return now.sa_handler == SIG_IGN;
}

}  // namespace

void wait_for_sigterm() {
  if (is_ignored(SIGTERM)) return;
  block_sigterm(0, nullptr, nullptr);
  std::thread([term = only_sigterm()] {
    int signal = 0;
    while (sigwait(&term, &signal) == 0) {
      if (!catches_sigterm.exchange(false)) end_by_sigterm();
      request_end();
    }
  }).detach();
}

void end_with_parent_if_asked() {
  constexpr const char* kAsked = "ORTHODYN_END_WITH_PARENT";
  if (!std::getenv(kAsked)) return;
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  unsetenv(kAsked);
}

const std::atomic<bool>& interrupted() { return flag; }

void cancel_time_limit() { alarm(0); }

void catch_interrupts() {
  std::signal(SIGALRM, end_at_once);
  std::signal(SIGINT, on_signal);
  catches_sigterm = true;
  if (!is_ignored(SIGHUP)) std::signal(SIGHUP, on_signal);  // ignored under nohup
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // exceeding a file size limit becomes a write error
}

}  // namespace orthodyn
