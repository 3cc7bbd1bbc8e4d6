// Ctrl-C as a flag that is read between steps; a second one ends the program.
#pragma once

#include <atomic>

namespace orthodyn {

// True from the first SIGINT or SIGTERM on, once catch_interrupts() was called.
const std::atomic<bool>& interrupted();
void catch_interrupts();

}  // namespace orthodyn
