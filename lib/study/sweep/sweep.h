// A sweep, as its YAML file says it: one scene, what is varied in it, and the metrics that are wanted of every point.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/study/inputs/limits.h"
#include "lib/study/inputs/scene_entry.h"
#include "lib/study/quantities/wanted_metric.h"
#include "lib/study/sweep/variable.h"

namespace orthodyn {

// How the values of several variables make points.
enum class Combine { cartesian, zip, latin_hypercube };
// What to do about points whose scene cannot be.
enum class Impossible { stop, keep };

template <>
struct EnumNames<Combine> {
  static constexpr std::array<std::pair<Combine, const char*>, 3> list{
      {{Combine::cartesian, "cartesian"}, {Combine::zip, "zip"}, {Combine::latin_hypercube, "latin_hypercube"}}};
};

// A picture of each point.
struct FrameSpec {
  std::optional<double> at;  // s; default the end
  std::string color = "displacement";
  std::vector<double> view{-60, 20};
  std::string up = "z";
  double enlarged = 1;
  int most = 24;
  bool ghost = true;
  SourceLocation origin;
  static const Spec<FrameSpec>& spec();
};

// A metric of the report; without any, it has what the number of variables suggests.
struct PlotSpec {
  std::string metric, x, lines;
  static const Spec<PlotSpec>& spec();
};

struct Sweep {
  std::string name;  // the file's stem
  std::string title, description;
  SceneEntry scene;
  Named<YamlText> definitions;  // numbers and formulas
  Combine combine = Combine::cartesian;
  std::optional<int> samples;  // of a Latin hypercube
  std::optional<long> seed;
  std::vector<Variable> vary;
  Named<WantedMetric> quantities;
  std::vector<PlotSpec> plots;
  std::optional<FrameSpec> frames;
  Impossible impossible = Impossible::stop;
  Limits limits;
  SourceLocation origin;
  static const Spec<Sweep>& spec();
};

// Throws ConfigError.
Sweep read_sweep(const Config& config);

// Each name and path must do something, mean one thing in formulas and head one column of the table. Throws
// ConfigError, with both places where two things clash.
void check_names(const Sweep& sweep);

}  // namespace orthodyn
