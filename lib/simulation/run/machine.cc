#include "lib/simulation/run/machine.h"

#include <fmt/chrono.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <limits>
#include <thread>

#include "lib/core/versions.h"
#include "lib/element/batch.h"
#include "lib/linear/blas.h"

namespace orthodyn {

namespace {

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

Json machine_json() {
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  return {{"processor", processor()},
          {"cores", std::thread::hardware_concurrency()},
          {"memory_bytes", memory},
          {"vectors", vector_instructions()}};
}

Json versions_json() {
  Json out{{"orthodyn", orthodyn_version()}, {"commit", orthodyn_commit()}};
  for (const auto& [library, version] : library_versions()) out[library] = version;
  out["BLAS"] = blas_name();
  return out;
}

// getrusage() is not used: its maximum includes the memory of the parent process before exec().
double peak_memory() {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::stod(line.substr(6));
  return std::numeric_limits<double>::quiet_NaN();
}

std::string utc_now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

}  // namespace orthodyn
