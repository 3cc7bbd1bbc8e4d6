#include "lib/core/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "lib/core/errors.h"

namespace orthodyn {

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr double kKibibyte = 1024;

double limit_of(decltype(RLIMIT_AS) resource) {
  rlimit limit{};
  const bool is_set = getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return is_set ? static_cast<double>(limit.rlim_cur) : kUnlimited;
}

// The first number of a file; infinite for "max" or if there is no such file.
double number_in(const std::filesystem::path& file) {
  double number = 0;
  return std::ifstream(file) >> number ? number : kUnlimited;
}

// The number after `name` in a file of lines "name number"; 0 if there is none.
double number_beside(const std::string& name, const std::filesystem::path& file) {
  std::ifstream in(file);
  double number = 0;
  for (std::string found; in >> found >> number;)
    if (found == name) return number;
  return 0;
}

// Names of files in the folder of a control group.
struct GroupFiles {
  const char *folder, *limit, *used, *unused_cache;
};
constexpr GroupFiles kVersion1{"memory", "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"};
constexpr GroupFiles kVersion2{"", "memory.max", "memory.current", "inactive_file"};

// Memory used by all processes of a group, without inactive file cache, which the kernel frees first.
double used_by(const std::filesystem::path& group, const GroupFiles& files) {
  const double used = number_in(group / files.used);
  return used < kUnlimited ? used - number_beside(files.unused_cache, group / "memory.stat") : 0;
}

// A value in bytes, from the line of a file in /proc that gives it in kB; 0 if there is no such line.
double proc_bytes(const char* file, const std::string& name) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(name + ":")) return kKibibyte * std::stod(line.substr(name.size() + 1));
  return 0;
}

GroupMemory memory_of_own_groups() { return memory_of_groups("/proc/self/cgroup", "/sys/fs/cgroup"); }

}  // namespace

GroupMemory memory_of_groups(const std::filesystem::path& groups, const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  GroupMemory least{kUnlimited, kUnlimited};
  std::ifstream in(groups);
  for (std::string line; std::getline(in, line);) {  // version 2: "0::/a/b"; version 1: "7:memory:/a/b"
    const bool is_first = line.find(":memory:") != std::string::npos;
    if (!is_first && !line.starts_with("0::")) continue;
    const GroupFiles& files = is_first ? kVersion1 : kVersion2;
    for (fs::path group = line.substr(line.rfind(':') + 2);; group = group.parent_path()) {
      const fs::path here = folder / files.folder / group;
      const double limit = number_in(here / files.limit);
      least.limit = std::min(least.limit, limit);
      if (limit < kUnlimited) least.left = std::min(least.left, limit - used_by(here, files));
      if (group.empty()) break;
    }
  }
  return least;
}

double memory_limit() {
  const double physical = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  return std::min({physical, limit_of(RLIMIT_AS), limit_of(RLIMIT_RSS), memory_of_own_groups().limit});
}

double memory_left() {
  const double free = proc_bytes("/proc/meminfo", "MemAvailable") + proc_bytes("/proc/meminfo", "SwapFree");
  const double addresses = limit_of(RLIMIT_AS) - proc_bytes("/proc/self/status", "VmSize");
  // RLIMIT_RSS is not included, because Linux does not enforce it.
  return std::max(0.0, std::min({free > 0 ? free : memory_limit(), addresses, memory_of_own_groups().left}));
}

void require_memory_for_factor(std::size_t bytes, const std::string& what, const std::string& remedy) {
  constexpr double kAlways = 64e6;  // allowed without a check
  constexpr double kGigabyte = 1e9;
  const auto needed = static_cast<double>(bytes);
  if (needed < kAlways) return;
  if (const double left = memory_left(); needed > left)
    throw RunError(fmt::format("{} does not fit in memory: it needs {:.3g} GB, and {:.3g} GB are left (of {:.3g} GB "
                               "that the process may use); {}",
                               what, needed / kGigabyte, left / kGigabyte, memory_limit() / kGigabyte, remedy),
                   Reason::out_of_memory);
}

bool address_space_is_limited() { return limit_of(RLIMIT_AS) < kUnlimited; }

}  // namespace orthodyn
