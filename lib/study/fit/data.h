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
  std::optional<double> relative = {};  // of a candidate: deviation over the computed value

  double deviation_at(double computed) const { return relative ? *relative * std::abs(computed) : deviation; }
};

// The data of an experiment, and the lists of measured modes that Datum::metric refers to.
struct Data {
  std::vector<Datum> data;
  std::vector<ModeMatching> matchings;
};

// Reads the tables, and checks quantities, units and times against `config`, the resolved scene. Throws ConfigError.
Data data_of(const Experiment& experiment, const Config& config);

}  // namespace orthodyn::study::fit
