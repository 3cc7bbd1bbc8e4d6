// SIGINT, SIGTERM and SIGHUP as a flag that computations read between steps. The program ends at once on a second
// signal, and 4 s after the first in any case, because a step or a factorisation may take hours.
#pragma once

#include <atomic>

namespace orthodyn {

// True after the first SIGINT, SIGTERM or SIGHUP; needs catch_interrupts().
const std::atomic<bool>& interrupted();

// Starts a thread that waits for SIGTERM and handles it, because METIS installs a handler that treats SIGTERM as its
// own error. No effect if SIGTERM is ignored.
void wait_for_sigterm();

// If the environment variable ORTHODYN_END_WITH_PARENT is set, the kernel sends SIGTERM when the parent process ends,
// so that a study does not outlive the Python process that started it. Unsets the variable, so that children do not
// inherit it.
void end_with_parent_if_asked();

// Cancels the limit of 4 s; called once the computation has ended, because drawing may take longer. A second signal
// still ends the program.
void cancel_time_limit();

// Installs the signal handlers; also ignores SIGPIPE, so that a closed output pipe does not end the program.
void catch_interrupts();

}  // namespace orthodyn
