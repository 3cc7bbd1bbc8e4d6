// Ctrl-C, and the other signals that end a program, as a flag that is read between steps. A second one ends it at once,
// and so do four seconds in which it has not come to its end: a step or a factorisation may take hours.
#pragma once

#include <atomic>

namespace orthodyn {

// True from the first SIGINT, SIGTERM or SIGHUP on, once catch_interrupts() was called.
const std::atomic<bool>& interrupted();
// METIS, which orders large matrices, takes SIGTERM for an error of its own while it runs, and the signal is lost: from
// here on a thread, which takes no signal itself, sets the program's handler again.
void keep_sigterm();
// From here on a reader of what is printed that goes away does not end the program, either.
void catch_interrupts();

}  // namespace orthodyn
