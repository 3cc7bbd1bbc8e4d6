// A stability study as declared in its YAML file: scenes with expectations (hard cases) x variants x integrators.
#pragma once

#include <string>
#include <vector>

#include "lib/study/inputs/integrator_entry.h"
#include "lib/study/inputs/limits.h"
#include "lib/study/inputs/scene_entry.h"

namespace orthodyn {

// A case: a file name or a section.
struct HardCase {
  FilePath file;
  std::string label;  // default the file's stem
  Assignments set;
  std::string model;  // reason why no integrator can pass, if the model itself is at fault; else ""
  SourceLocation origin;
  static const Spec<HardCase>& spec();
};

// An integrator: a name, `all`, or a section {type, label, any option including rtol}.
struct StabilityIntegrator : IntegratorEntry {};

struct Stability {
  std::string name;  // the file's stem
  std::string title, description;
  std::vector<HardCase> cases;
  std::vector<StabilityIntegrator> integrators;
  Named<Assignments> variants;  // changes of the scenes, by name
  Limits limits{20, 4e9};       // s, bytes
  static const Spec<Stability>& spec();
};

template <>
struct Value<HardCase> {
  static ValueSchema schema() { return file_entry_schema<HardCase>("HardCase"); }
  static HardCase read(const Config& c, const Rule&) { return read_file_entry<HardCase>(c); }
  static std::string yaml(const HardCase&) { return ""; }
};

template <>
struct Value<StabilityIntegrator> {
  static ValueSchema schema();
  static StabilityIntegrator read(const Config& c, const Rule& rule);
  static std::string yaml(const StabilityIntegrator&) { return ""; }
};

// Reads and checks a file of hard cases. Throws ConfigError.
Stability read_stability(const Config& config);

// One entry of the matrix: a case with a variant and an integrator.
struct StabilityRun {
  std::size_t hard_case = 0, variant = 0, integrator = 0;
  std::string title;  // "mirrored, warped, cvode_bdf"
  Config scene;       // resolved
};

// All runs, ordered by case, variant, integrator. A run keeps the options of the scene's own integrator, including
// rtol, that the study's integrator also has and does not set. Throws ConfigError for an invalid scene or one without
// expectations.
std::vector<StabilityRun> stability_runs(const Stability& stability);

}  // namespace orthodyn
