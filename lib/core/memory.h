// The memory that a process may use.
#pragma once

namespace orthodyn {

// In bytes: what the machine has, or less where a limit is set (ulimit -v, ulimit -m, which the system itself does not
// enforce).
double memory_limit();

// Whether addresses are limited (ulimit -v), and not only what is resident.
bool addresses_are_limited();

}  // namespace orthodyn
