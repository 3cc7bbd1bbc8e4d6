// A sweep as declared in its YAML file: a scene, the variables, and the metrics of every point.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/study/inputs/limits.h"
#include "lib/study/inputs/scene_entry.h"
#include "lib/study/quantities/wanted_metric.h"
#include "lib/study/sweep/variable.h"

namespace orthodyn {

// How the values of several variables are combined into points.
enum class Combine { cartesian, zip, latin_hypercube };
// Treatment of points with an invalid scene.
enum class Impossible { stop, keep };

template <>
struct EnumNames<Combine> {
  static constexpr std::array<std::pair<Combine, const char*>, 3> list{
      {{Combine::cartesian, "cartesian"}, {Combine::zip, "zip"}, {Combine::latin_hypercube, "latin_hypercube"}}};
};

// Pictures of the points.
struct FrameSpec {
  std::optional<double> at;  // s; empty for the end
  std::string color = "displacement";
  std::vector<double> view{-60, 20};  // azimuth and elevation, degrees
  std::string up = "z";
  double enlarged = 1;  // scale factor of the deformation
  int most = 24;        // largest number of pictures
  bool ghost = true;    // draw the outline of the rest shape
  SourceLocation origin;
  static const Spec<FrameSpec>& spec();
};

// A plot of the report. Without plots, the report chooses them by the number of variables.
struct PlotSpec {
  std::string metric, x, lines;
  static const Spec<PlotSpec>& spec();
};

struct Sweep {
  std::string name;  // the file's stem
  std::string title, description;
  SceneEntry scene;
  Named<YamlText> definitions;  // named numbers and formulas, for use in formulas
  Combine combine = Combine::cartesian;
  std::optional<int> samples;  // number of points of a Latin hypercube
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

// Reads and checks a sweep file. Throws ConfigError.
Sweep read_sweep(const Config& config);

// Checks that names and paths are used, unambiguous in formulas, and unique as columns of the table. Throws
// ConfigError; for a conflict it names both places.
void check_names(const Sweep& sweep);

}  // namespace orthodyn
