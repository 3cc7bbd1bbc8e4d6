#include "lib/core/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace orthodyn {

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr double kKibibyte = 1024;

double limit_of(decltype(RLIMIT_AS) resource) {
  rlimit limit{};
  const bool is_set = getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return is_set ? static_cast<double>(limit.rlim_cur) : kUnlimited;
}

// The first number of a file; infinite for "max" and where there is no such file.
double number_in(const std::filesystem::path& file) {
  double number = 0;
  return std::ifstream(file) >> number ? number : kUnlimited;
}

// The least of this process's control group and those above it.
double group_limit() {
  namespace fs = std::filesystem;
  double least = kUnlimited;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // "0::/a/b", of version 1 "7:memory:/a/b"
    const bool is_first = line.find(":memory:") != std::string::npos;
    if (!is_first && !line.starts_with("0::")) continue;
    const fs::path root = is_first ? "/sys/fs/cgroup/memory" : "/sys/fs/cgroup";
    const char* file = is_first ? "memory.limit_in_bytes" : "memory.max";
    fs::path group = line.substr(line.rfind(':') + 2);
    for (;; group = group.parent_path()) {
      least = std::min(least, number_in(root / group / file));
      if (group.empty()) break;
    }
  }
  return least;
}

// A line of a file of /proc in kB, in bytes; 0 where there is none.
double proc_bytes(const char* file, const std::string& name) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(name + ":")) return kKibibyte * std::stod(line.substr(name.size() + 1));
  return 0;
}

}  // namespace

double memory_limit() {
  const double physical = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  return std::min({physical, limit_of(RLIMIT_AS), limit_of(RLIMIT_RSS), group_limit()});
}

double memory_left() {
  const double free = proc_bytes("/proc/meminfo", "MemAvailable") + proc_bytes("/proc/meminfo", "SwapFree");
  const double addresses = limit_of(RLIMIT_AS) - proc_bytes("/proc/self/status", "VmSize");
  const double resident = group_limit() - proc_bytes("/proc/self/status", "VmRSS");  // Linux ignores RLIMIT_RSS
  return std::max(0.0, std::min({free > 0 ? free : memory_limit(), addresses, resident}));
}

bool addresses_are_limited() { return limit_of(RLIMIT_AS) < kUnlimited; }

}  // namespace orthodyn
