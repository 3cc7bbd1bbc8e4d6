// Ctrl-C, and the other signals that end a program, as a flag that is read between steps. A second one ends it at once,
// and so do four seconds in which it has not come to its end: a step or a factorisation may take hours.
#pragma once

#include <atomic>

namespace orthodyn {

// True from the first SIGINT, SIGTERM or SIGHUP on, once catch_interrupts() was called.
const std::atomic<bool>& interrupted();
// A thread of its own waits for SIGTERM from here on, and does what the signal is to do: METIS, which orders large
// matrices, would take it for an error of its own. Without effect where the program was started to ignore it.
void wait_for_sigterm();
// Where the environment variable ORTHODYN_END_WITH_PARENT is set, the program gets a SIGTERM when the one that started
// it ends in any way: a study of a Python that is killed does not go on for hours. Programs that it starts do not see
// it.
void end_with_parent_if_asked();
// What was interrupted has come to its end: what is left to do, such as drawing, may take longer than four seconds. A
// second signal still ends it.
void take_time_to_end();
// From here on a reader of what is printed that goes away does not end the program, either.
void catch_interrupts();

}  // namespace orthodyn
