#include "tools/orthodyn/interrupt.h"

#include <csignal>

namespace orthodyn {

namespace {

std::atomic<bool> flag{false};

void set_flag(int signal) {
  flag = true;
  std::signal(signal, signal == SIGHUP ? SIG_IGN : SIG_DFL);  // shell and kernel may each send one
}

}  // namespace

const std::atomic<bool>& interrupted() { return flag; }

void catch_interrupts() {
  std::signal(SIGINT, set_flag);
  std::signal(SIGTERM, set_flag);
  if (std::signal(SIGHUP, set_flag) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // under nohup
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace orthodyn
