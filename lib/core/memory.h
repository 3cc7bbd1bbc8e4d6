// The memory that a process may use.
#pragma once

namespace orthodyn {

// In bytes: what the machine has, or less where a limit is set (ulimit -v, ulimit -m, which the system itself does not
// enforce).
double memory_limit();

}  // namespace orthodyn
