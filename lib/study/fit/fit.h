// A fit: numbers of scenes (stiffnesses, grain angles, damping) that explain measured values best. The input file of
// `orthodyn fit`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/scene/expectation.h"
#include "lib/study/inputs/limits.h"
#include "lib/study/inputs/scene_entry.h"
#include "lib/study/quantities/wanted_metric.h"

namespace orthodyn::study::fit {

// An unknown of a measurement that is estimated with the parameters: gain, offset or time offset of the instrument.
struct Nuisance {
  std::string name;  // default EXPERIMENT.N.gain, with the number N of the entry of `measured`
  std::optional<YamlText> start;
  std::optional<YamlText> deviation;  // standard deviation of the start; empty: nothing is known of it
  SourceLocation origin;
  static const Spec<Nuisance>& spec();
};

// How measured frequencies find their computed modes: by number, by the nearest frequency, or by shape.
enum class MatchBy { order, nearest, shape };

// An entry of `measured`: one value, the lowest natural frequencies, or a table of values over time or frequency.
// Exactly one of `quantity`, `mode` and `frequencies` is set.
struct Measurement {
  std::string quantity;                    // "tip.displacement.z"
  std::optional<int> mode;                 // number from 1, without rigid modes
  std::vector<YamlText> frequencies;       // of modes 1, 2, ...; null for one that was not measured
  std::optional<MatchBy> match;            // of `frequencies`; see match_by()
  std::optional<double> band;              // of MatchBy::nearest, relative
  std::optional<FilePath> shapes;          // CSV: amplitudes of the modes of `frequencies`
  std::optional<Vec3> direction;           // along which `shapes` are measured
  std::optional<double> at;                // time of `value`, s
  std::optional<ResponseMetric> response;  // in a harmonic analysis
  std::optional<double> frequency;         // of the response, Hz
  std::optional<QuantityValue> value;
  std::optional<FilePath> table;           // CSV
  std::string column, over;                // columns of the table: of the values; of the times or frequencies
  std::string unit;                        // of the column's values; default the one in its heading, else SI
  std::optional<QuantityValue> deviation;  // standard deviation; exactly one of the four
  std::optional<double> relative;          // standard deviation relative to the value
  std::string deviation_column;            // of the table: the standard deviation of each value
  std::vector<YamlText> deviations;        // of `frequencies`; null for one that was not measured
  std::optional<Nuisance> gain, offset, time_offset;  // reading(t) = gain * quantity(t + time_offset) + offset
  SourceLocation origin;
  static const Spec<Measurement>& spec();

  // `match`, or its default: by shape if there are shapes, else by order.
  MatchBy match_by() const { return match.value_or(shapes ? MatchBy::shape : MatchBy::order); }
};

struct Experiment {
  SceneEntry scene;
  std::vector<Measurement> measured;
  SourceLocation origin;
  static const Spec<Experiment>& spec();
};

// Expected value and standard deviation of a parameter, known before the fit.
struct Prior {
  YamlText value, deviation;
  static const Spec<Prior>& spec();
};

struct Parameter {
  std::string path;               // of a number in the scenes: "materials.spruce.young.0"
  std::vector<std::string> also;  // further paths that have the same value
  std::optional<YamlText> start, lower, upper;
  std::optional<Prior> prior;
  std::optional<Scale> scale;        // default: log for positive numbers, linear for angles and negative numbers
  std::optional<double> smoothness;  // of a field (lib/study/fit/field.h)
  SourceLocation origin;
  static const Spec<Parameter>& spec();
};

// Treatment of large residuals: in full, or with less weight (Huber's and Cauchy's loss).
enum class Loss { squares, huber, cauchy };

// Intervals of the parameters: from the linearised covariance only, or also by profile likelihood.
enum class Intervals { linear, profile };

struct Fit {
  std::string name;  // the file's stem
  std::string title, description;
  Named<Experiment> experiments;
  Named<Parameter> parameters;
  Named<Experiment> candidates;  // possible further experiments: `measured` without values
  Loss loss = Loss::squares;
  Intervals intervals = Intervals::linear;
  int starts = 1;
  long seed = 1;
  double spread = 2;  // further starts are within this factor of the first one
  int iterations = 50;
  double tolerance = 1e-8;  // relative change of the parameters at which the search ends
  bool refine = true;       // also estimate the change of the parameters on refined meshes
  Limits limits{.seconds = 600};
  SourceLocation origin;
  static const Spec<Fit>& spec();
};

// Reads and checks a fit file. Throws ConfigError.
Fit read_fit(const Config& config);

}  // namespace orthodyn::study::fit

namespace orthodyn {

template <>
struct EnumNames<study::fit::MatchBy> {
  using MatchBy = study::fit::MatchBy;
  static constexpr std::array<std::pair<MatchBy, const char*>, 3> list{
      {{MatchBy::order, "order"}, {MatchBy::nearest, "nearest"}, {MatchBy::shape, "shape"}}};
};

template <>
struct EnumNames<study::fit::Loss> {
  using Loss = study::fit::Loss;
  static constexpr std::array<std::pair<Loss, const char*>, 3> list{
      {{Loss::squares, "squares"}, {Loss::huber, "huber"}, {Loss::cauchy, "cauchy"}}};
};

template <>
struct EnumNames<study::fit::Intervals> {
  using Intervals = study::fit::Intervals;
  static constexpr std::array<std::pair<Intervals, const char*>, 2> list{
      {{Intervals::linear, "linear"}, {Intervals::profile, "profile"}}};
};

// `E1: materials.spruce.young.0` is short for `E1: {path: materials.spruce.young.0}`.
template <>
struct Value<study::fit::Parameter> {
  static ValueSchema schema();
  static study::fit::Parameter read(const Config& c, const Rule&);
  static std::string yaml(const study::fit::Parameter&) { return ""; }
};

}  // namespace orthodyn
