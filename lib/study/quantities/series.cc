#include "lib/study/quantities/series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace orthodyn {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr int kSamplesPerStep = 4;

// The vertex of the parabola through the largest sample and its neighbours.
struct Vertex {
  double t = kNone, value = kNone;
};

// True if the curvature at each neighbour of sample k is at least a quarter of `a`, the curvature at sample k (both are
// half the second derivative). This is not so at a corner, such as the end of a ramp, where a parabola would overshoot.
bool is_smooth(const Series& s, std::size_t k, double a) {
  constexpr double kFraction = 0.25;
  const auto curvature = [&](std::size_t i) {  // half the second derivative
    const double h0 = s.times[i] - s.times[i - 1], h1 = s.times[i + 1] - s.times[i];
    return ((s.values[i + 1] - s.values[i]) / h1 - (s.values[i] - s.values[i - 1]) / h0) / (h0 + h1);
  };
  return (k < 2 || curvature(k - 1) / a >= kFraction) && (k + 2 >= s.size() || curvature(k + 1) / a >= kFraction);
}

Vertex vertex(const Series& s, double sign) {
  if (s.times.empty()) return {};
  const auto better = [&](double a, double b) { return sign * a < sign * b; };
  const auto k =
      static_cast<std::size_t>(std::max_element(s.values.begin(), s.values.end(), better) - s.values.begin());
  const Vertex sample{s.times[k], s.values[k]};
  if (k == 0 || k + 1 == s.size()) return sample;
  const double h0 = s.times[k - 1] - s.times[k], h1 = s.times[k + 1] - s.times[k];
  const double y0 = s.values[k - 1] - s.values[k], y1 = s.values[k + 1] - s.values[k];
  // Parabola y = b h + a h^2 through the neighbours, with h and y relative to sample k.
  const double a = (y1 / h1 - y0 / h0) / (h1 - h0), b = y0 / h0 - a * h0;
  if (!(sign * a < 0) || !is_smooth(s, k, a)) return sample;
  return {s.times[k] - b / (2 * a), s.values[k] - b * b / (4 * a)};
}

// Integral from sample k to k + 1 of the parabola through samples k, k + 1, k + 2 (Newton's divided differences).
double integral_over_first(const Series& s, std::size_t k) {
  const double h = s.times[k + 1] - s.times[k], g = s.times[k + 2] - s.times[k + 1];
  const double slope = (s.values[k + 1] - s.values[k]) / h, next = (s.values[k + 2] - s.values[k + 1]) / g;
  return h * (s.values[k] + h * (slope / 2 - (next - slope) / (h + g) * h / 6));
}

// Integral from sample k + 1 to k + 2 of the same parabola.
double integral_over_last(const Series& s, std::size_t k) {
  const double h = s.times[k + 1] - s.times[k], g = s.times[k + 2] - s.times[k + 1];
  const double slope = (s.values[k + 1] - s.values[k]) / h, next = (s.values[k + 2] - s.values[k + 1]) / g;
  return g * (s.values[k + 2] - g * (next / 2 + (next - slope) / (h + g) * g / 6));
}

// True if the two intervals after sample k differ by a factor of 4 at most.
bool has_even_steps(const Series& s, std::size_t k) {
  const double h = s.times[k + 1] - s.times[k], g = s.times[k + 2] - s.times[k + 1];
  return std::max(h, g) <= 4 * std::min(h, g);
}

// The size to which a drift or gain is relative.
double reference_size(const Expectation& e, const SeriesRecorder& recorder, std::size_t q) {
  const Series& series = recorder.series(q);
  double scale = e.of.value_or(0);
  if (!e.of && e.quantity == kEnergyBalance) scale = recorder.energy_scale();
  if (!e.of && e.quantity != kEnergyBalance)
    for (int c = 0; c < series.components; ++c) scale = std::hypot(scale, series.values[static_cast<std::size_t>(c)]);
  return scale;  // NaN or 0 if there is none: the metric then fails
}

}  // namespace

double maximum(const Series& series, double sign) { return vertex(series, sign).value; }

double time_of_maximum(const Series& series, double sign) { return vertex(series, sign).t; }

double mean(const Series& s) {
  const auto n = s.size();
  if (n < 2) return kNone;
  double sum = 0;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    // Averages the integrals of two parabolas, which also pass through the sample before or after the interval; the
    // first and the last interval have only one. A parabola through very uneven samples is left out: they lie at a
    // jump, where it would overshoot. If none is left, uses the trapezoidal rule.
    double pieces = 0;
    int count = 0;
    if (k > 0 && has_even_steps(s, k - 1)) pieces += integral_over_last(s, k - 1), ++count;
    if (k + 2 < n && has_even_steps(s, k)) pieces += integral_over_first(s, k), ++count;
    sum += count > 0 ? pieces / count : 0.5 * (s.values[k] + s.values[k + 1]) * (s.times[k + 1] - s.times[k]);
  }
  return sum / (s.times.back() - s.times.front());
}

double frequency(const Series& s) {
  const double level = mean(s);
  double first = kNone, last = kNone;
  int crossings = 0;
  for (std::size_t k = 1; k < s.size(); ++k) {
    const double before = s.values[k - 1] - level, now = s.values[k] - level;
    if (!(before < 0 && now >= 0)) continue;
    last = s.times[k - 1] + (s.times[k] - s.times[k - 1]) * before / (before - now);
    if (++crossings == 1) first = last;
  }
  return crossings < 2 ? kNone : (crossings - 1) / (last - first);
}

double settling_time(const Series& s, double share) {
  if (s.size() < 2) return kNone;
  const auto [least, most] = std::minmax_element(s.values.begin(), s.values.end());
  const double last = s.values.back(), band = share * (*most - *least), start = s.times.front();
  std::size_t k = s.size() - 1;
  while (k > 0 && std::abs(s.values[k - 1] - last) <= band) --k;
  if (k == 0) return 0;
  // Linear between the last sample outside the band and the first inside.
  const double outside = std::abs(s.values[k - 1] - last), inside = std::abs(s.values[k] - last);
  const double t = s.times[k - 1] + (s.times[k] - s.times[k - 1]) * (outside - band) / (outside - inside);
  return t - start > 0.9 * (s.times.back() - start) ? kNone : t - start;
}

double drift(const Series& s) {
  const auto n = static_cast<std::size_t>(s.components);
  double largest = s.size() == 0 ? kNone : 0;
  for (std::size_t k = 0; k < s.size(); ++k) {
    double squares = 0;
    for (std::size_t c = 0; c < n; ++c) squares += std::pow(s.values[k * n + c] - s.values[c], 2);
    if (std::isnan(squares)) return kNone;
    largest = std::max(largest, std::sqrt(squares));
  }
  return largest;
}

double gain(const Series& s) {
  double largest = s.size() == 0 ? kNone : 0;
  for (const double value : s.values) {
    if (std::isnan(value)) return kNone;
    largest = std::max(largest, value - s.values[0]);
  }
  return largest;
}

double onset(const Series& s, double level) {
  for (std::size_t k = 0; k < s.size(); ++k) {
    const double now = std::abs(s.values[k]);
    if (now < level) continue;
    if (k == 0) return s.times[0];
    const double before = std::abs(s.values[k - 1]);
    return s.times[k - 1] + (s.times[k] - s.times[k - 1]) * (level - before) / (now - before);
  }
  return kNone;
}

SeriesRecorder::SeriesRecorder(const Model& model, const Integrator& integrator, std::vector<Quantity> quantities)
    : model_(model), quantities_(std::move(quantities)) {
  for (const auto& q : quantities_) {
    series_.push_back({q.components(), {}, {}});
    if (!q.values && !energy_) energy_ = std::make_unique<EnergyMeter>(model, integrator);
  }
}

void SeriesRecorder::on_start(const ObservedState& observed) {
  if (energy_) energy_->on_start(observed);
  record(observed);
}

// Output times are sampled in on_step(), together with the other times, because the energy balance needs ascending
// times.
void SeriesRecorder::on_output(const ObservedState& observed) { pending_.push_back(observed.t()); }

void SeriesRecorder::on_step(const StepInfo& info, const ObservedState& observed, const Integrator& integrator) {
  std::vector<double> samples = pending_;
  const double h = info.t - last_t_, count = kSamplesPerStep * smooth_parts(integrator, h);
  for (double k = 1; k < count; ++k) samples.push_back(last_t_ + h * k / count);
  std::sort(samples.begin(), samples.end());
  for (const double t : samples) {
    if (t <= last_t_ || t >= info.t) continue;
    State within;
    integrator.interpolate(t, within);
    record({model_, within});
  }
  record(observed);
  pending_.clear();
}

double SeriesRecorder::at(std::size_t quantity, double t) const {
  const Series& s = series_[quantity];
  const auto after = std::lower_bound(s.times.begin(), s.times.end(), t);
  const auto nearest = after == s.times.begin()                                  ? after
                       : after == s.times.end() || t - *(after - 1) < *after - t ? after - 1
                                                                                 : after;
  return s.values[static_cast<std::size_t>(nearest - s.times.begin())];
}

void SeriesRecorder::record(const ObservedState& observed) {
  if (energy_) energy_->on_output(observed);
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    const auto v = values(q, observed);
    series_[q].times.push_back(observed.t());
    series_[q].values.insert(series_[q].values.end(), v.begin(), v.end());
  }
  last_t_ = observed.t();
}

std::vector<double> SeriesRecorder::values(std::size_t quantity, const ObservedState& observed) const {
  const auto& q = quantities_[quantity];
  if (!q.values) return {energy_->last().balance()};
  return q.values(observed);
}

double metric(const Expectation& e, const SeriesRecorder& recorder, std::size_t q) {
  const Series& series = recorder.series(q);
  if (e.at) return recorder.at(q, *e.at);
  switch (e.take) {
    case TimeReduction::end: return series.values.back();
    case TimeReduction::max: return maximum(series);
    case TimeReduction::min: return maximum(series, -1);
    case TimeReduction::time_of_max: return time_of_maximum(series);
    case TimeReduction::time_of_min: return time_of_maximum(series, -1);
    case TimeReduction::mean: return mean(series);
    case TimeReduction::frequency: return frequency(series);
    case TimeReduction::drift: return drift(series) / reference_size(e, recorder, q);
    case TimeReduction::gain: return gain(series) / reference_size(e, recorder, q);
    case TimeReduction::onset: return e.of ? onset(series, *e.of) : std::nan("");
  }
  return 0;
}

std::vector<double> requested_times(const std::vector<Expectation>& expectations, double start) {
  std::set<double> times;
  for (const auto& e : expectations)
    if (e.at && *e.at > start) times.insert(*e.at);
  return {times.begin(), times.end()};
}

}  // namespace orthodyn
