// Gains, offsets and time offsets of measurements as parameters of the search.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lib/study/fit/problem.h"
#include "lib/study/fit/sampled_series.h"

namespace orthodyn::study::fit {

namespace {

enum class Kind { gain, offset, time_offset };

// The parameter of a nuisance, and the scale of its coordinate.
struct Unknown {
  FittedParameter parameter;
  double scale = 1;
  bool is_log = false;
};

Unknown unknown_of(const Nuisance& nuisance, const std::string& si, double start) {
  Unknown out;
  out.parameter.is_nuisance = true;
  out.parameter.origin = nuisance.origin;
  out.parameter.start = nuisance.start ? number_of(*nuisance.start, si) : start;
  if (!nuisance.deviation) return out;
  out.parameter.prior = out.parameter.start;
  out.parameter.deviation = number_of(*nuisance.deviation, si);
  if (!(*out.parameter.deviation > 0)) nuisance.origin.fail("the deviation must be positive");
  return out;
}

// Searched by its logarithm, so that its interval is relative. A negative one is a reversed polarity.
Unknown gain_of(const Nuisance& nuisance) {
  Unknown out = unknown_of(nuisance, "", 1);
  if (out.parameter.start == 0) nuisance.origin.fail("the start of a gain must not be 0");
  out.is_log = out.parameter.start > 0;
  out.scale = std::abs(out.parameter.start);
  return out;
}

// The scale is the largest measured value.
Unknown offset_of(const Nuisance& nuisance, const std::vector<const Datum*>& data) {
  const Datum& first = *data.front();
  Unknown out = unknown_of(nuisance, first.si, 0);
  out.parameter.unit = first.unit, out.parameter.factor = first.factor;
  out.scale = 0;
  for (const Datum* datum : data) out.scale = std::max(out.scale, std::abs(datum->value));
  if (!(out.scale > 0)) out.scale = first.deviation;
  return out;
}

// The scale is a tenth of the time in which the series is sampled.
Unknown time_offset_of(const Nuisance& nuisance, const SampledSeries& series) {
  Unknown out = unknown_of(nuisance, "s", 0);
  out.parameter.unit = "ms", out.parameter.factor = 1e-3;
  out.parameter.start = series.start;
  out.parameter.lower = series.low, out.parameter.upper = series.high;
  out.scale = 0.1 * (series.times.back() - series.times.front());
  return out;
}

// The nuisances of a fit by name, and what else identifies them.
struct Known {
  std::size_t parameter;
  Kind kind;
  std::string si;
};

bool are_same(const FittedParameter& a, const FittedParameter& b) {
  return a.start == b.start && a.deviation == b.deviation && a.prior == b.prior;
}

// Limits a shared time offset to the range that both of its entries allow.
void share(FittedParameter& known, const FittedParameter& other) {
  if (!known.lower) return;
  known.lower = std::max(*known.lower, *other.lower);
  known.upper = std::min(*known.upper, *other.upper);
}

std::vector<const Datum*> data_of_entry(const PreparedExperiment& experiment, std::size_t entry) {
  std::vector<const Datum*> out;
  for (const Datum& datum : experiment.data)
    if (datum.entry == entry) out.push_back(&datum);
  return out;
}

}  // namespace

void Problem::add_nuisances(const Fit& fit) {
  std::map<std::string, Known> known;
  // The index of a new or a shared parameter.
  const auto add = [&](const std::string& own_name, const Nuisance& nuisance, Kind kind, const std::string& si,
                       Unknown unknown) {
    const std::string name = nuisance.name.empty() ? own_name : nuisance.name;
    if (std::ranges::any_of(fit.parameters, [&](const auto& p) { return p.first == name; }))
      nuisance.origin.fail(fmt::format("'{}' is already the name of a parameter; give another one", name));
    const auto [entry, is_new] = known.emplace(name, Known{parameters_.size(), kind, si});
    const Known& found = entry->second;
    if (!is_new) {
      if (found.kind != kind || found.si != si || !are_same(parameters_[found.parameter], unknown.parameter))
        nuisance.origin.fail(fmt::format(
            "'{}' is already the name of a nuisance of another kind, unit, start or deviation; give the same ones, or "
            "another name",
            name));
      share(parameters_[found.parameter], unknown.parameter);
      return found.parameter;
    }
    unknown.parameter.name = name;
    parameters_.push_back(std::move(unknown.parameter));
    for (PreparedExperiment& experiment : experiments_) experiment.paths.emplace_back();
    if (unknown.is_log) coordinates_.add_log();
    else coordinates_.add_linear(unknown.scale);
    return found.parameter;
  };
  for (std::size_t e = 0; e < fit.experiments.size(); ++e) {
    PreparedExperiment& experiment = experiments_[e];
    const auto& measured = fit.experiments[e].second.measured;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const Measurement& m = measured[i];
      const std::vector<const Datum*> data = data_of_entry(experiment, i);
      const std::string prefix = fmt::format("{}.{}.", experiment.name, i + 1), si = data.front()->si;
      std::optional<std::size_t> gain, offset, time_offset;
      if (m.gain) gain = add(prefix + "gain", *m.gain, Kind::gain, "", gain_of(*m.gain));
      if (m.offset) offset = add(prefix + "offset", *m.offset, Kind::offset, si, offset_of(*m.offset, data));
      if (m.time_offset)
        time_offset = add(prefix + "time_offset", *m.time_offset, Kind::time_offset, "s",
                          time_offset_of(*m.time_offset, experiment.series[*data.front()->series]));
      for (Datum& datum : experiment.data)
        if (datum.entry == i) datum.gain = gain, datum.offset = offset, datum.time_offset = time_offset;
    }
  }
}

}  // namespace orthodyn::study::fit
