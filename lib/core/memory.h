// The memory that a process may use, in bytes.
#pragma once

namespace orthodyn {

// What the machine has, or less where a limit is set: of the control group (containers, batch systems), or by ulimit -v
// and ulimit -m, which the system itself does not enforce.
double memory_limit();

// What this process may still take now: of what the machine has free, swap included, and of the same limits.
double memory_left();

// Whether addresses are limited (ulimit -v), and not only what is resident.
bool addresses_are_limited();

}  // namespace orthodyn
