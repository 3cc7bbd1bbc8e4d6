#include "tools/orthodyn/interrupt.h"

#include <pthread.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace orthodyn {

namespace {

constexpr unsigned kSecondsToEnd = 4;  // what waits for the program's end may give it five

std::atomic<bool> flag{false};
std::atomic<void (*)(int)> handler_of_sigterm{SIG_DFL};

void set_flag(int signal) {
  flag = true;
  if (signal == SIGTERM) handler_of_sigterm = SIG_DFL;
  std::signal(signal, signal == SIGHUP ? SIG_IGN : SIG_DFL);  // shell and kernel may each send one
  alarm(kSecondsToEnd);
}

// A step or a factorisation can take longer. Only what is safe in a signal handler; processes that were started die
// with this one (process.cc), and files are whole at any time, or cut back by --resume.
void end_at_once(int) {
  static constexpr char kText[] =
      "\ninterrupted: ended after 4 s in the middle of a computation; what was written by then is kept\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kText, sizeof kText - 1);
  _exit(130);
}

}  // namespace

void keep_sigterm() {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread([] {
    for (;; std::this_thread::sleep_for(std::chrono::milliseconds(100))) std::signal(SIGTERM, handler_of_sigterm);
  }).detach();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

const std::atomic<bool>& interrupted() { return flag; }

void catch_interrupts() {
  std::signal(SIGALRM, end_at_once);
  std::signal(SIGINT, set_flag);
  handler_of_sigterm = set_flag;
  std::signal(SIGTERM, set_flag);
  if (std::signal(SIGHUP, set_flag) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // under nohup
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace orthodyn
