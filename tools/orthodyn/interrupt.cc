#include "tools/orthodyn/interrupt.h"

#include <csignal>

namespace orthodyn {

namespace {

std::atomic<bool> wish{false};

void note(int signal) {
  wish = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

const std::atomic<bool>& interrupted() { return wish; }

void heed_interrupts() {
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
}

}  // namespace orthodyn
