#include "tools/orthodyn/interrupt.h"

#include <pthread.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <thread>

namespace orthodyn {

namespace {

constexpr unsigned kSecondsToEnd = 4;  // what waits for the program's end may give it five

std::atomic<bool> flag{false};
std::atomic<bool> catches_sigterm{false};

sigset_t only_sigterm() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGTERM);
  return set;
}

// Blocked in every thread, so that nobody's handler runs: before the libraries are initialised, for OpenBLAS starts
// threads then, which inherit it.
void block_sigterm(int, char**, char**) {
  const sigset_t term = only_sigterm();
  pthread_sigmask(SIG_BLOCK, &term, nullptr);
}
[[gnu::section(".preinit_array"), gnu::used]] void (*block_before_all_else)(int, char**, char**) = block_sigterm;

void begin_to_end() {
  flag = true;
  alarm(kSecondsToEnd);
}

void on_signal(int signal) {
  std::signal(signal, signal == SIGHUP ? SIG_IGN : SIG_DFL);  // shell and kernel may each send one
  begin_to_end();
}

void end_by_sigterm() {
  std::signal(SIGTERM, SIG_DFL);
  const sigset_t term = only_sigterm();
  pthread_sigmask(SIG_UNBLOCK, &term, nullptr);
  std::raise(SIGTERM);
}

// A step or a factorisation can take longer. Only what is safe in a signal handler; processes that were started die
// with this one (process.cc), and files are whole at any time, or cut back by --resume.
void end_at_once(int) {
  static constexpr char kText[] =
      "\ninterrupted: ended after 4 s in the middle of a computation; what was written by then is kept\n";
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
      begin_to_end();
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

void take_time_to_end() { alarm(0); }

void catch_interrupts() {
  std::signal(SIGALRM, end_at_once);
  std::signal(SIGINT, on_signal);
  catches_sigterm = true;
  if (!is_ignored(SIGHUP)) std::signal(SIGHUP, on_signal);  // it is under nohup
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that reaches its limit is an error of writing
}

}  // namespace orthodyn
