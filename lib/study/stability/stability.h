// Hard cases, as a YAML file names them: scenes that expect metrics x integrators x changes to the force.
#pragma once

#include <string>
#include <vector>

#include "lib/study/inputs/integrator_entry.h"
#include "lib/study/inputs/limits.h"

namespace orthodyn {

// In the list of cases: a file, or a section.
struct HardCase {
  FilePath file;
  std::string label;  // default the file's stem
  Assignments set;
  std::string model;  // where the model itself is at fault and no integrator can help: why, in words
  SourceLocation origin;
  static const Spec<HardCase>& spec();
};

// In the list of integrators: a name, `all`, or a section {type, label, any option}, rtol among them.
struct StabilityIntegrator : IntegratorEntry {};

struct Stability {
  std::string name;  // the file's stem
  std::string title, description;
  std::vector<HardCase> cases;
  std::vector<StabilityIntegrator> integrators;
  Named<Assignments> variants;  // of the scenes, by name
  Limits limits{20, 4e9};
  static const Spec<Stability>& spec();
};

template <>
struct Value<HardCase> {
  static ValueSchema schema() {
    const ValueSchema section{
        .kind = ValueSchema::Kind::section, .title = "HardCase", .keys = [] { return HardCase::spec().keys(); }};
    return {.kind = ValueSchema::Kind::either, .items = {Value<FilePath>::schema(), section}};
  }
  static HardCase read(const Config& c, const Rule&);
  static std::string yaml(const HardCase&) { return ""; }
};

template <>
struct Value<StabilityIntegrator> {
  static ValueSchema schema();
  static StabilityIntegrator read(const Config& c, const Rule& rule);
  static std::string yaml(const StabilityIntegrator&) { return ""; }
};

// Throws ConfigError.
Stability read_stability(const Config& config);

// One field of the matrix: a case with one force and one integrator, as it will run.
struct StabilityRun {
  std::size_t hard_case = 0, variant = 0, integrator = 0;
  std::string title;  // "mirrored, warped, cvode_bdf"
  Config scene;       // resolved
};

// All of them, by case, then variant, then integrator. Options of a scene's own integrator, rtol among them, are kept
// where an integrator has such keys. Throws ConfigError, also for a scene that is at fault or expects nothing.
std::vector<StabilityRun> stability_runs(const Stability& stability);

}  // namespace orthodyn
