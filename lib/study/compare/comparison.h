// A comparison of integrators, as its YAML file says it: scenes x integrators x (tolerances or steps)
// x whatever else is varied.
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
  std::optional<CompleteIntegratorEntry> integrator, check;
  Assignments set;        // keys of the mesh that hold for the reference only: errors are then those of the mesh, too
  double seconds = 1800;  // limit
  static const Spec<ReferenceOptions>& spec();
};

// What each point and each reference keeps for the 3D view: `count` of its samples, the last among them.
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
  std::vector<IntegratorEntry> integrators;  // `all`: every one of the registry
  std::vector<double> tolerances, steps;
  SourceLocation tolerances_at = {}, steps_at = {};  // their places in the file
  Named<std::vector<YamlText>> vary;                 // by path in a scene
  std::vector<std::string> quantities = {};          // whose errors are measured beside displacement and velocity
  std::optional<KeptFrames> frames = {};
  int repeats = 3, samples = 100;
  Limits limits;
  ReferenceOptions reference;

  static const Spec<Comparison>& spec();
};

// Whether a path in a scene names what a mesh of the same body may differ in.
bool is_of_mesh(const std::string& path);

// Throws ConfigError.
Comparison read_comparison(const Config& config);

}  // namespace orthodyn
