// A file with the state of a run, from which another process can resume the run.
//
// The file is a CBOR sequence (RFC 8742): the text "orthodyn checkpoint <version> <fingerprint>", then a map. Numbers
// are stored exactly. The fingerprint is computed from the map's bytes, so that a damaged file is rejected.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "lib/ode/output.h"
#include "lib/simulation/checkpoint/archive.h"
#include "lib/simulation/checkpoint/total_cost.h"

namespace orthodyn {

// Records that a run was resumed.
struct Restart {
  double time = 0;                   // s
  std::string at;                    // date and time
  std::string after;                 // how the run had ended before: "killed", "failed", ...
  std::vector<std::string> changed;  // keys of the scene whose values changed on resuming
};

// Output times of the first run. If the run is extended, the interval stays the same.
struct OutputSchedule {
  double start = 0, end = 0;  // s
  double interval = 0;        // s; 0: no outputs
};

struct Checkpoint {
  std::string scene;                         // resolved, as YAML
  std::string mesh;                          // fingerprint
  std::map<std::string, std::string> files;  // fingerprints of the files named in the scene, by path
  bool begun = false;                        // false: nothing has been computed or written
  State state;                               // at the end of a step
  double last_output = 0, last_history = 0;  // times of the last output and history row, s
  OutputSchedule schedule;
  TotalCost cost;
  std::vector<Restart> restarts;
  std::map<std::string, Archive> observers;

  // Writes the file atomically and syncs it to the disk. Throws RunError.
  void save(const std::filesystem::path& path) const;
  // Throws ConfigError for a file that is missing, truncated, damaged or of another version.
  static Checkpoint load(const std::filesystem::path& path);
};

}  // namespace orthodyn
