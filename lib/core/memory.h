// The memory that a process may use, in bytes.
#pragma once

#include <filesystem>

namespace orthodyn {

// What the machine has, or less where a limit is set: of the control group (containers, batch systems), or by ulimit -v
// and ulimit -m, which the system itself does not enforce.
double memory_limit();

// What this process may still take now: of what the machine has free, swap included, and of the same limits.
double memory_left();

// The least of the control groups that a process is in, and of those above them; infinite where none is limited. What
// is left is so for all processes of a group together.
struct GroupMemory {
  double limit, left;
};
// `groups`: a process's /proc/.../cgroup; `folder`: where the groups' files are, /sys/fs/cgroup. Versions 1 and 2.
GroupMemory memory_of_groups(const std::filesystem::path& groups, const std::filesystem::path& folder);

// Whether addresses are limited (ulimit -v), and not only what is resident.
bool addresses_are_limited();

}  // namespace orthodyn
