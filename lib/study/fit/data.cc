#include "lib/study/fit/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/config/csv_table.h"
#include "lib/core/spelling.h"
#include "lib/scene/build.h"
#include "lib/scene/quantity.h"
#include "lib/simulation/harmonic/response_columns.h"
#include "lib/simulation/sensitivity/motion_sensitivity.h"
#include "lib/study/fit/headings.h"
#include "lib/study/fit/measured_shapes.h"
#include "lib/study/fit/sampled_series.h"
#include "lib/study/quantities/response_metric.h"

namespace orthodyn::study::fit {

namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kBand = 0.2;  // default of `band`

class Reader {
 public:
  explicit Reader(const Config& config) : config_(config), scene_(read_scene(config)), built_(build(scene_)) {}

  Data read(const Experiment& experiment) {
    for (std::size_t i = 0; i < experiment.measured.size(); ++i) {
      entry_ = i;
      add(experiment.measured[i]);
    }
    return {std::move(data_), std::move(matchings_), std::move(series_)};
  }

 private:
  void add(const Measurement& m) {
    if (!m.frequencies.empty()) add_frequencies(m);
    else if (m.table) add_table(m);
    else add_value(m);
  }

  void add_frequencies(const Measurement& m) {
    const bool is_matched = m.match_by() != MatchBy::order;
    ModeMatching matching{std::vector<double>(m.frequencies.size(), kNotANumber), m.band.value_or(kBand), {}, {}, {}};
    double before = 0;
    for (std::size_t k = 0; k < m.frequencies.size(); ++k) {
      const Config given = parsed(m.frequencies[k]);
      if (given.is_null()) continue;
      double value = 0;
      try {
        value = read_number(given, {.unit = "Hz", .range = kPositive});
      } catch (const ConfigError& e) {
        m.origin.fail(fmt::format("frequencies: number {}: {}", k + 1, e.what()));
      }
      if (value < before && m.match_by() != MatchBy::shape)
        m.origin.fail(
            fmt::format("frequencies: number {} is below the one before it; frequencies are matched with ascending "
                        "computed ones, so list them in ascending order (with 'shapes' any order is allowed)",
                        k + 1));
      before = matching.frequencies[k] = value;
      add_frequency(m, static_cast<int>(k) + 1, value, is_matched);
      if (!m.deviations.empty()) data_.back().deviation = deviation_of_frequency(m, k);
    }
    if (before == 0) m.origin.fail("frequencies: none was measured, all are null");
    if (m.shapes) read_shapes(m, *built_.model, matching);
    if (is_matched) matchings_.push_back(std::move(matching));
  }

  static double deviation_of_frequency(const Measurement& m, std::size_t k) {
    try {
      return read_number(parsed(m.deviations[k]), {.unit = "Hz", .range = kPositive});
    } catch (const ConfigError& e) {
      m.origin.fail(fmt::format("deviations: number {}: {}", k + 1, e.what()));
    }
  }

  // `is_matched`: `mode` is the number of the frequency in the next entry of `matchings_`.
  void add_frequency(const Measurement& m, int mode, double value, bool is_matched) {
    if (scene_.harmonic)
      m.origin.fail(
          "a natural frequency is measured, and the scene is a harmonic analysis, which computes responses only: give "
          "the frequency to an experiment of its own, with scene: {file: ..., set: {analysis: null, harmonic: null}}");
    WantedMetric metric{.mode = mode};
    if (is_matched) metric.matching = static_cast<int>(matchings_.size());
    push(m, metric, fmt::format("frequency {}{}", is_matched ? "" : "of mode ", mode), value, "Hz", "Hz");
    data_.back().has_derivatives = true;
  }

  void add_value(const Measurement& m) {
    if (m.mode) {
      if (m.value) m.value->require("Hz", m.origin);
      return add_frequency(m, *m.mode, m.value ? m.value->si() : kNotANumber, false);
    }
    const WantedMetric metric = metric_of(m, m.at, m.frequency);
    const std::string si = si_unit(metric);
    if (m.value) m.value->require(si, m.origin);
    push(m, metric, title_of(metric), m.value ? m.value->si() : kNotANumber, si, si);
  }

  void add_table(const Measurement& m) {
    if (scene_.is_static())
      m.origin.fail("'table' is for values over time or frequency, and this scene is static: give 'value'");
    const CsvTable table = read_csv_with_gaps(*m.table);
    const auto column = [&](const std::string& name) {
      if (table.has(name)) return table.column(name);
      m.origin.fail(fmt::format("{} has no column '{}'{} There are {}", m.table->path, name,
                                did_you_mean(name, table.names, "."), join(table.names)));
    };
    const std::size_t values = column(m.column);
    const std::size_t over = m.over.empty() ? 0 : column(m.over);
    if (values == over) m.origin.fail("'column' and 'over' are the same column; name another one");
    const std::optional<std::size_t> deviations =
        m.deviation_column.empty() ? std::nullopt : std::optional(column(m.deviation_column));
    const double over_factor = factor_of(unit_in(table.names[over]), scene_.harmonic ? "Hz" : "s", m.origin);
    const std::string unit = m.unit.empty() ? unit_in(m.column) : m.unit;
    std::size_t count = 0;
    if (m.time_offset && scene_.harmonic)
      m.origin.fail("'time_offset' is for tables over time, and this scene is a harmonic analysis; remove it");
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const double x = over_factor * table.at(row, over), y = table.at(row, values);
      if (std::isnan(x) || std::isnan(y)) continue;
      const double inside = m.time_offset ? std::clamp(x, scene_.time.start, scene_.time.end) : x;
      const WantedMetric metric = scene_.harmonic ? metric_of(m, {}, x) : metric_of(m, inside, {});
      const std::string si = si_unit(metric);
      push(m, metric, title_of(metric), y * factor_of(unit, si, m.origin), si, unit.empty() ? si : unit);
      data_.back().over = x;
      if (deviations) {
        const std::string own = unit_in(m.deviation_column);
        const double deviation = table.at(row, *deviations) * factor_of(own.empty() ? unit : own, si, m.origin);
        if (!(deviation > 0))
          throw ConfigError(table.where(row),
                            fmt::format("the standard deviation in column '{}' must be positive", m.deviation_column));
        data_.back().deviation = deviation;
      }
      if (m.time_offset) data_.back().series = series_.size();
      ++count;
    }
    if (count == 0) m.origin.fail(fmt::format("{}: column '{}' has no values", m.table->path, m.column));
    if (!m.time_offset) return;
    std::vector<double> times;
    for (std::size_t d = data_.size() - count; d < data_.size(); ++d) times.push_back(*data_[d].over);
    series_.push_back(sampled_series(*m.time_offset, data_.back().metric, std::move(times), scene_.time));
  }

  WantedMetric metric_of(const Measurement& m, std::optional<double> at, std::optional<double> frequency) const {
    WantedMetric metric{.quantity = m.quantity, .at = at, .response = m.response, .frequency = frequency};
    metric.origin = m.origin;
    if (scene_.harmonic) {
      if (at) m.origin.fail("'at' is a time, and this scene is a harmonic analysis: give 'frequency'");
      check_response(metric);
    } else if (metric.is_of_response()) {
      m.origin.fail("'response' and 'frequency' are for a harmonic analysis, which this scene is not");
    }
    if (scene_.is_static() && at) m.origin.fail("'at' is a time, and this scene is static; remove it");
    if (at && (*at < scene_.time.start || *at > scene_.time.end))
      m.origin.fail(fmt::format("the scene runs from {} to {} s, and the value is measured at {} s", scene_.time.start,
                                scene_.time.end, *at));
    return metric;
  }

  void check_response(const WantedMetric& metric) const {
    const ResponseMetric wanted = metric.response_metric();
    const bool needs_frequency = wanted == ResponseMetric::amplitude || wanted == ResponseMetric::phase;
    if (needs_frequency != metric.frequency.has_value())
      metric.origin.fail(needs_frequency ? "amplitude and phase need a 'frequency'"
                                         : "'frequency' is for amplitude and phase; remove it");
  }

  std::string si_unit(const WantedMetric& metric) const {
    const FemModel& model = *built_.model;
    if (scene_.harmonic) {
      const auto columns = response_columns(scene_, model);
      return metric_unit(metric.response_metric(), columns[find_column(columns, metric.quantity, metric.origin)].unit);
    }
    const Quantity quantity = find_quantity(metric.quantity, scene_, model, metric.origin);
    if (quantity.components() > 1) metric.origin.fail(quantity.ask_for_component());
    return metric.unit_of(quantity.unit);
  }

  static std::string title_of(const WantedMetric& metric) {
    if (metric.is_of_response()) return response_title(metric.response_metric(), metric.quantity, metric.frequency);
    return metric.at ? fmt::format("{} at {:.6g} s", metric.quantity, *metric.at) : metric.quantity;
  }

  bool has_response_slopes(const WantedMetric& metric) const {
    if (!scene_.harmonic || !built_.model->traits().smooth) return false;
    const auto columns = response_columns(scene_, *built_.model);
    return has_slopes(columns[find_column(columns, metric.quantity, metric.origin)], metric.response_metric());
  }

  // `unit`: of display.
  void push(const Measurement& m, const WantedMetric& metric, const std::string& title, double value,
            const std::string& si, const std::string& unit) {
    if (m.deviation) m.deviation->require(si, m.origin);
    const double deviation = m.deviation  ? m.deviation->si()
                             : m.relative ? *m.relative * std::abs(value)
                                          : kNotANumber;  // set by the caller
    const bool is_candidate = std::isnan(value);
    if (!(deviation > 0) && m.relative && !is_candidate)
      m.origin.fail(fmt::format("the value {} has no relative deviation: give 'deviation'", value));
    Datum datum{title, entry_, metric, value, deviation, unit, factor_of(unit, si, m.origin)};
    datum.si = si;
    if (is_candidate) datum.relative = m.relative;
    datum.has_derivatives = metric.quantity != kEnergyBalance &&
                            (scene_.analysis == Analysis::statical ||
                             (metric.at && has_motion_sensitivity(config_, scene_, {})) || has_response_slopes(metric));
    data_.push_back(std::move(datum));
  }

  const Config& config_;
  Scene scene_;
  BuiltScene built_;
  std::size_t entry_ = 0;
  std::vector<Datum> data_;
  std::vector<ModeMatching> matchings_;
  std::vector<SampledSeries> series_;
};

}  // namespace

Data data_of(const Experiment& experiment, const Config& config) { return Reader(config).read(experiment); }

}  // namespace orthodyn::study::fit
