// Ctrl-C as a wish that is looked at between steps; a second one ends the program.
#pragma once

#include <atomic>

namespace orthodyn {

// True from the first SIGINT or SIGTERM on, once heed_interrupts() was called.
const std::atomic<bool>& interrupted();
void heed_interrupts();

}  // namespace orthodyn
