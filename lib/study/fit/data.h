// The measured values of a fit, one by one.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lib/study/fit/fit.h"
#include "lib/study/quantities/mode_matching.h"

namespace orthodyn::study::fit {

struct Datum {
  std::string title;                // "frequency of mode 3", "tip.displacement.z at 0.25 s"
  std::size_t entry;                // of `measured`; data of a table have the same entry
  WantedMetric metric;              // computed by the scene
  double value;                     // SI; NaN for candidates
  double deviation;                 // SI; NaN if `relative`
  std::string unit;                 // of display, for people
  double factor = 1;                // from `unit` to SI
  std::optional<double> over = {};  // time (s) or frequency (Hz) in a table
  // Whether its derivatives are exact (EvaluationResult::derivatives). Otherwise they are differences between runs.
  bool has_derivatives = false;
  std::optional<double> relative = {};     // of a candidate: deviation over the computed value
  std::string si = {};                     // SI unit
  std::optional<std::size_t> series = {};  // index in Data::series, from which the quantity is interpolated
  // Indices of the problem's parameters: reading(t) = gain * quantity(t + time_offset) + offset.
  std::optional<std::size_t> gain = {}, offset = {}, time_offset = {};

  double deviation_at(double computed) const { return relative ? *relative * std::abs(computed) : deviation; }
};

// Samples of a quantity over time, from which values at shifted times are interpolated.
struct SampledSeries {
  WantedMetric metric;                   // without a time
  std::vector<double> times;             // s, ascending
  double start = 0, low = 0, high = 0;   // of the time offset, s
  std::optional<double> deviation = {};  // s
};

// The data of an experiment, with the lists of measured modes and the series that they refer to.
struct Data {
  std::vector<Datum> data;
  std::vector<ModeMatching> matchings;
  std::vector<SampledSeries> series;
};

// Reads the tables, and checks quantities, units and times against `config`, the resolved scene. Throws ConfigError.
Data data_of(const Experiment& experiment, const Config& config);

}  // namespace orthodyn::study::fit
