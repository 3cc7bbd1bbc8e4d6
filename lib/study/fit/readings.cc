#include "lib/study/fit/readings.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/study/fit/interpolation.h"

namespace orthodyn::study::fit {

namespace {

std::string name_of_datum(std::size_t datum) { return fmt::format("d{}", datum); }
std::string name_of_sample(std::size_t series, std::size_t sample) { return fmt::format("s{}_{}", series, sample); }

template <class T>
const T& entry_of(const Named<T>& list, const std::string& name) {
  const auto found = std::ranges::find_if(list, [&](const auto& entry) { return entry.first == name; });
  if (found == list.end()) throw Failed("the run has no value of a measured quantity");
  return found->second;
}

}  // namespace

void add_metrics(const PreparedExperiment& experiment, EvaluationInput& input) {
  for (std::size_t d = 0; d < experiment.data.size(); ++d)
    if (!experiment.data[d].series) input.metrics.emplace_back(name_of_datum(d), experiment.data[d].metric);
  for (std::size_t s = 0; s < experiment.series.size(); ++s)
    for (std::size_t k = 0; k < experiment.series[s].times.size(); ++k) {
      WantedMetric metric = experiment.series[s].metric;
      metric.at = experiment.series[s].times[k];
      input.metrics.emplace_back(name_of_sample(s, k), metric);
    }
}

double Readings::value(std::optional<std::size_t> parameter, double otherwise) const {
  return parameter ? values_[static_cast<Eigen::Index>(*parameter)] : otherwise;
}

double Readings::time(const Datum& datum) const { return *datum.over + value(datum.time_offset, 0); }

double Readings::quantity(std::size_t d) const {
  const Datum& datum = experiment_.data[d];
  if (!datum.series) return entry_of(result_.metrics, name_of_datum(d));
  const Stencil stencil = stencil_at(experiment_.series[*datum.series].times, time(datum));
  double sum = 0;
  for (std::size_t k = 0; k < stencil.weights.size(); ++k)
    sum += stencil.weights[k] * entry_of(result_.metrics, name_of_sample(*datum.series, stencil.first + k));
  return sum;
}

double Readings::rate(std::size_t d) const {
  const Datum& datum = experiment_.data[d];
  const Stencil stencil = stencil_at(experiment_.series[*datum.series].times, time(datum));
  double sum = 0;
  for (std::size_t k = 0; k < stencil.slopes.size(); ++k)
    sum += stencil.slopes[k] * entry_of(result_.metrics, name_of_sample(*datum.series, stencil.first + k));
  return sum;
}

double Readings::gain(std::size_t d) const { return value(experiment_.data[d].gain, 1); }

double Readings::reading(std::size_t d) const { return gain(d) * quantity(d) + value(experiment_.data[d].offset, 0); }

std::vector<double> Readings::derivatives(std::size_t d) const {
  const Datum& datum = experiment_.data[d];
  if (!datum.series) return entry_of(result_.derivatives, name_of_datum(d));
  const Stencil stencil = stencil_at(experiment_.series[*datum.series].times, time(datum));
  std::vector<double> sum;
  for (std::size_t k = 0; k < stencil.weights.size(); ++k) {
    const auto& own = entry_of(result_.derivatives, name_of_sample(*datum.series, stencil.first + k));
    sum.resize(own.size());
    for (std::size_t i = 0; i < own.size(); ++i) sum[i] += stencil.weights[k] * own[i];
  }
  return sum;
}

std::optional<ModeMatch> Readings::match(std::size_t d) const {
  for (const auto& [name, match] : result_.matches)
    if (name == name_of_datum(d)) return match;
  return {};
}

void Readings::add_derivatives(std::size_t d, Eigen::RowVectorXd& row) const {
  const Datum& datum = experiment_.data[d];
  const auto at = [](std::size_t parameter) { return static_cast<Eigen::Index>(parameter); };
  if (datum.gain) row[at(*datum.gain)] += quantity(d);
  if (datum.offset) row[at(*datum.offset)] += 1;
  if (datum.time_offset) row[at(*datum.time_offset)] += gain(d) * rate(d);
}

}  // namespace orthodyn::study::fit
