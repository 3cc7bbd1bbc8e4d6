// A comparison of integrators as declared in its YAML file: scenes x integrators x (tolerances or steps) x further
// varied keys.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/scene/output_files.h"
#include "lib/study/inputs/integrator_entry.h"
#include "lib/study/inputs/limits.h"
#include "lib/study/inputs/scene_entry.h"

namespace orthodyn {

enum class ReferenceKind { automatic, computed, none };

struct ReferenceOptions {
  ReferenceKind kind = ReferenceKind::automatic;
  std::optional<CompleteIntegratorEntry> integrator, check;  // empty for the defaults
  Assignments set;        // changes to the reference's mesh only; if there are any, errors include the mesh error
  double seconds = 1800;  // wall time limit of the reference and of the check
  static const Spec<ReferenceOptions>& spec();
};

// Frames of each point and each reference for the report's 3D view: the initial state and `count` samples, including
// the last.
struct KeptFrames {
  int count = 20;
  FrameFields fields{"displacement", "velocity"};
  static const Spec<KeptFrames>& spec();
};

struct Comparison {
  std::string name;  // the file's stem
  std::string title;
  std::string description;
  std::vector<SceneEntry> scenes;
  std::vector<IntegratorEntry> integrators;  // `all` is replaced by every registered integrator
  std::vector<double> tolerances, steps;     // values of rtol; step sizes, s
  SourceLocation tolerances_at = {}, steps_at = {};
  Named<std::vector<YamlText>> vary;         // values of further keys, by path in the scene
  std::vector<std::string> quantities = {};  // measured in addition to displacement and velocity
  std::optional<KeptFrames> frames = {};
  int repeats = 3, samples = 100;  // timed runs of each point; times at which errors are measured
  Limits limits;
  ReferenceOptions reference;

  static const Spec<Comparison>& spec();
};

// True if the key at `path` changes the discretisation but not the body: "mesh.cells".
bool keeps_body(const std::string& path);

// Reads and checks a comparison file. Throws ConfigError.
Comparison read_comparison(const Config& config);

}  // namespace orthodyn
