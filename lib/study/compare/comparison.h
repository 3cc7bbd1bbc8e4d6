// A comparison of integrators, as its YAML file says it: scenes x integrators x (tolerances or steps)
// x whatever else is varied.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/config/spec.h"

namespace orthodyn {

// YAML that is handed on as it stands: a value for a key of a scene.
struct YamlText {
  std::string text;
  Origin origin = {};
};

template <>
struct Value<YamlText> {
  static Shape shape() { return {}; }
  static YamlText read(const Config& c, const Rule&) { return {c.yaml(), {c.where()}}; }
  static std::string yaml(const YamlText& x) { return x.text; }
};

// Values of a scene by path, and where they come from: the place of what is wrong with them.
using Assignments = Named<YamlText>;

// In the list of scenes: a file, or a section.
struct SceneEntry {
  FilePath file;
  std::string label;    // default the file's stem
  Named<YamlText> set;  // by path
  Origin origin;
  static const Spec<SceneEntry>& spec();
};

// In the list of integrators: a name, or a section {type, label, any option of the integrator}.
struct IntegratorEntry {
  std::string type, label;
  Named<YamlText> options;
  Origin origin;
  bool by_all = false;  // named by `all`: left out if it takes nothing that the comparison gives
};

// With `all` replaced by one entry for each of the registry.
std::vector<IntegratorEntry> expand_all(const std::vector<IntegratorEntry>& entries);

// The same, with all that controls its error.
struct ReferenceEntry : IntegratorEntry {};

struct Limits {
  double seconds = 60;  // of wall time of one integration
  double memory = 8e9;  // bytes in use by one process
  static const Spec<Limits>& spec();
};

enum class ReferenceKind { automatic, computed, none };

struct ReferenceOptions {
  ReferenceKind kind = ReferenceKind::automatic;
  std::optional<ReferenceEntry> integrator, check;
  double seconds = 1800;                      // limit
  static const Spec<ReferenceOptions>& spec();
};

struct Comparison {
  std::string name;         // the file's stem
  std::string title;
  std::string description;
  std::vector<SceneEntry> scenes;
  std::vector<IntegratorEntry> integrators;  // `all`: every one of the registry
  std::vector<double> tolerances, steps;
  Named<std::vector<YamlText>> vary;  // by path in a scene
  int repeats = 3, samples = 100;
  Limits limits;
  ReferenceOptions reference;

  static const Spec<Comparison>& spec();
};

// Throws ConfigError.
Comparison read_comparison(const Config& config);

// A section or a scalar in a list: `- beam.yaml` is short for `- {file: beam.yaml}`.
template <>
struct Value<SceneEntry> {
  static Shape shape() {
    const Shape section{.kind = Shape::Kind::section, .title = "SceneEntry", .keys = [] { return SceneEntry::spec().keys(); }};
    return {.kind = Shape::Kind::either, .items = {Value<FilePath>::shape(), section}};
  }
  static SceneEntry read(const Config& c, const Rule&);
  static std::string yaml(const SceneEntry&) { return ""; }
};

template <>
struct Value<IntegratorEntry> {
  static Shape shape();
  static IntegratorEntry read(const Config& c, const Rule&);
  static std::string yaml(const IntegratorEntry&) { return ""; }
};

template <>
struct Value<ReferenceEntry> {
  static Shape shape();
  static ReferenceEntry read(const Config& c, const Rule&);
  static std::string yaml(const ReferenceEntry&) { return ""; }
};

}  // namespace orthodyn
