// Ctrl-C, and the other signals that end a program, as a flag that is read between steps; a second one ends it.
#pragma once

#include <atomic>

namespace orthodyn {

// True from the first SIGINT, SIGTERM or SIGHUP on, once catch_interrupts() was called.
const std::atomic<bool>& interrupted();
// From here on a reader of what is printed that goes away does not end the program, either.
void catch_interrupts();

}  // namespace orthodyn
