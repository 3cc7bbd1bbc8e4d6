// Everything that a run needs to go on in another process, as one file.
//
// The file is a CBOR sequence (RFC 8742): the text "orthodyn checkpoint <version> <fingerprint>", then
// a map. Numbers come back bit by bit. The fingerprint is that of the map's bytes: a damaged file is
// refused.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "lib/ode/output.h"
#include "lib/simulation/checkpoint/archive.h"
#include "lib/simulation/checkpoint/effort.h"

namespace orthodyn {

// That a run was taken up again.
struct Restart {
  double time = 0;                   // s, where
  std::string at;                    // date and time
  std::string after;                 // how it had ended: "killed", "failed", ...
  std::vector<std::string> changed;  // keys of the scene with another value from there on
};

// The output times of the first plan: a run that is extended keeps their interval.
struct OutputSchedule {
  double start = 0, end = 0;  // s, of the first plan
  double interval = 0;        // s; 0: no outputs
};

struct Checkpoint {
  std::string scene;                         // resolved, as YAML
  std::string mesh;                          // its fingerprint
  std::map<std::string, std::string> files;  // fingerprints of those that the scene names, by their paths in it
  bool begun = false;                        // false: nothing has been computed or written yet
  State state;                               // at the end of a step
  double last_output = 0, last_history = 0;  // s
  OutputSchedule schedule;
  Effort effort;
  std::vector<Restart> restarts;
  std::map<std::string, Archive> observers;

  // Whole or absent, and on the disk when it returns. Throws RunError.
  void save(const std::filesystem::path& path) const;
  // Throws ConfigError for a file that is missing, cut short, damaged or of another version.
  static Checkpoint load(const std::filesystem::path& path);
};

}  // namespace orthodyn
