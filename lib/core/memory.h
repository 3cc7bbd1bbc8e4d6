// The memory that this process may use, in bytes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace orthodyn {

// The smallest of: the machine's memory, the limits of the control groups (containers, batch systems), ulimit -v, and
// ulimit -m (which Linux itself does not enforce).
double memory_limit();

// Memory that this process can still allocate: what the machine has free, including swap, but no more than what is left
// within the limits of the control groups and ulimit -v.
double memory_left();

// Throws RunError (out_of_memory) if `bytes` exceed memory_left(): the machine would swap, or the system would kill the
// process. Less than 64 MB is always allowed. `what`: "the Cholesky factor"; `remedy`: "use a coarser mesh".
void require_memory_for_factor(std::size_t bytes, const std::string& what, const std::string& remedy);

// Memory limit, and memory left below it. Each is the smallest value over a process's control groups and their parents;
// infinite if no group has a limit. All processes of a group share what is left.
struct GroupMemory {
  double limit, left;
};
// Reads control groups of versions 1 and 2. `groups`: /proc/.../cgroup of the process; `folder`: /sys/fs/cgroup.
GroupMemory memory_of_groups(const std::filesystem::path& groups, const std::filesystem::path& folder);

// True if the address space is limited (ulimit -v).
bool address_space_is_limited();

}  // namespace orthodyn
